import { readdirSync, readFileSync, statSync } from "node:fs";
import type { FileSource } from "../files/source.ts";

/** A folder of this computer as a source of files; paths are those of the disk. */
export const disk: FileSource = {
  read: path => (statSync(path, { throwIfNoEntry: false })?.isFile() ? readFileSync(path) : undefined),
  list: folder =>
    statSync(folder === "" ? "." : folder, { throwIfNoEntry: false })?.isDirectory()
      ? readdirSync(folder === "" ? "." : folder)
      : undefined,
};
