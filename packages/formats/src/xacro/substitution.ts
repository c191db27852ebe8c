import { findPackage } from "../files/resolve.ts";
import { folderOf, type FileSource } from "../files/source.ts";
import { Refusal } from "../refusal.ts";
import { shorten } from "../xml.ts";
import type { Value } from "./expression/values.ts";

/** What `$(…)` may ask for. */
export interface NetworkEmulator {
  readonly files: FileSource;
  /** The file being expanded at this moment. */
  file(): string;
  argument(name: string): string | undefined;
  /** Works out `$(eval …)`. */
  expression(text: string): Value;
}

/**
 * `arg`, `find`, `dirname`, `eval`, `optenv` with its default. There are no environment variables here: `env` is
 * refused, so that a file means the same everywhere. A package that is not at hand stays `package://name`, and only
 * what is in it is missing.
 */
export function substitute(inside: string, around: NetworkEmulator): Value {
  const [command = "", ...words] = inside.trim().split(/\s+/);
  const [name] = words;
  switch (command) {
    case "arg": {
      const value = name === undefined ? undefined : around.argument(name);
      if (value === undefined)
        throw new Refusal(
          `The argument ${shorten(name ?? "")} has no value; give it as ${shorten(name ?? "name")}:=value.`,
        );
      return value;
    }
    case "find": {
      if (name === undefined) throw new Refusal("“$(find)” names no package.");
      return findPackage(name, around.file(), around.files) ?? `package://${name}`;
    }
    case "dirname":
      return folderOf(around.file()) || ".";
    case "eval":
      return around.expression(inside.trim().slice(4));
    case "optenv":
      return words.slice(1).join(" ");
    case "env":
      throw new Refusal(
        `“$(env ${shorten(name ?? "")})” asks for a variable of the computer's environment, which is not read; use an argument.`,
      );
    default:
      throw new Refusal(`“$(${shorten(inside)})” is not known; arg, find, dirname, eval and optenv are.`);
  }
}
