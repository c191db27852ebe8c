import { folderOf, joinPath, nameOf, type FileSource } from "../files/source.ts";
import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import type { DaeUp } from "../mesh/dae.ts";
import { finishImport } from "./finish.ts";
import type { Imported } from "./part.ts";
import { endingOf, rawParts, SHAPE_ENDINGS, STEP_ENDINGS, stemOf } from "./raw-parts.ts";
import { robotParts } from "./robot-parts.ts";
import { stepParts, type OcctResult } from "./step-parts.ts";

export interface ImportOptions {
  /** Metres per unit of the file, when a person says so. */
  readonly metresPerUnit?: number | undefined;
  readonly daeUp?: DaeUp | undefined;
  /** Reads a STEP file by a CAD kernel, which is loaded by whoever calls. */
  readonly readStep?: ((bytes: Uint8Array) => OcctResult) | undefined;
}

/** Endings of everything that `importFile` takes, without dots. */
export const IMPORT_ENDINGS: readonly string[] = [...SHAPE_ENDINGS, ...STEP_ENDINGS, "urdf", "xacro"];

/**
 * Imports a file of shapes or a robot description: parts with names, colours and places in metres, z up, and a report
 * of what was mended. Whatever the bytes are, the answer is parts or one sentence.
 *
 * @param path   of the file in `files`; what it names is looked for from there.
 */
export function importFile(path: string, files: FileSource, options: ImportOptions = {}): Imported | NotUnderstood {
  return answering(() => {
    const bytes = files.read(path);
    if (!bytes) throw new Refusal(`${nameOf(path)} is not there or cannot be read.`);
    if (bytes.length === 0) throw new Refusal(`${nameOf(path)} is empty.`);
    const ending = endingOf(path);
    const finish = { metresPerUnit: options.metresPerUnit };
    if (ending === "urdf" || ending === "xacro") return finishImport(stemOf(path), robotParts(path, files), finish);
    if (STEP_ENDINGS.includes(ending)) {
      if (!/^\s*ISO-10303-21/.test(String.fromCharCode(...bytes.subarray(0, 256))))
        throw new Refusal("The file does not begin with “ISO-10303-21”: it is no STEP file.");
      if (!options.readStep) throw new Refusal("STEP files need the CAD kernel, which is not loaded here.");
      return finishImport(stemOf(path), stepParts(options.readStep(bytes)), finish);
    }
    const answer = rawParts(path, bytes, {
      other: address => files.read(joinPath(folderOf(path), address)),
      daeUp: options.daeUp,
    });
    if (answer.kind === "not-understood") throw new Refusal(answer.sentence, answer.line);
    return finishImport(stemOf(path), answer, finish);
  });
}

/**
 * Which files of a folder or archive are to be imported: a robot description where there is one (those that others
 * include are left out: the one nearest the top counts), else every shape.
 */
export function filesToImport(paths: readonly string[]): readonly string[] {
  const sorted = [...paths].sort((a, b) => depth(a) - depth(b) || (a < b ? -1 : 1));
  const robots = sorted.filter(path => endingOf(path) === "urdf");
  const macros = sorted.filter(path => endingOf(path) === "xacro" && !/macro/i.test(nameOf(path)));
  const robot = robots[0] ?? macros[0];
  if (robot !== undefined) return [robot];
  return sorted.filter(path => [...SHAPE_ENDINGS, ...STEP_ENDINGS].includes(endingOf(path)));
}
const depth = (path: string): number => path.split("/").length;
