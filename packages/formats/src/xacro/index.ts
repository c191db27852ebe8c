import type { FileSource } from "../files/source.ts";
import { answering, type NotUnderstood } from "../refusal.ts";
import { writeXml } from "../xml-write.ts";
import { robotOf } from "../urdf/read.ts";
import type { UrdfRead } from "../urdf/model.ts";
import { Expansion } from "./expand.ts";

export { isXacro } from "./expand.ts";

export interface XacroOptions {
  /** Values of the file's arguments, as `name:=value` on a command line. */
  readonly args?: Readonly<Record<string, string>>;
}
export interface XacroExpanded {
  readonly kind: "expanded";
  /** The URDF. */
  readonly text: string;
  /** Every file that was read for it, the first is the one asked for. */
  readonly read: readonly string[];
  readonly warnings: readonly string[];
}

/**
 * The URDF that a xacro stands for. Pure: what it names is asked of `files`, nothing else is opened; there are no
 * environment variables. Work, depth and size are bounded, so that every file ends in a robot or in a sentence.
 */
export function expandXacro(
  path: string,
  files: FileSource,
  { args = {} }: XacroOptions = {},
): XacroExpanded | NotUnderstood {
  return answering(() => {
    const expansion = new Expansion(files, args);
    const root = expansion.whole(path);
    return { kind: "expanded", text: writeXml(root), read: expansion.read, warnings: [...expansion.warnings] };
  });
}

/**
 * A robot straight from a URDF or xacro; refusals name file and line of what was written by hand, not of what it
 * became.
 */
export function readRobot(path: string, files: FileSource, { args = {} }: XacroOptions = {}): UrdfRead | NotUnderstood {
  return answering(() => {
    const expansion = new Expansion(files, args);
    const root = expansion.whole(path);
    const { robot, warnings } = robotOf(root);
    return { kind: "read", robot, warnings: [...expansion.warnings, ...warnings] };
  });
}
