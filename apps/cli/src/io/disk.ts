import { readdirSync, readFileSync, statSync } from "node:fs";
import type { FileSource } from "@twincell/formats";

/** A robot description is text; what is larger was named by mistake. */
const LARGEST_FILE = 600_000_000;

/** The files of this computer, by absolute path. What cannot be read is not there. */
export const disk: FileSource = {
  read(path) {
    const found = statSync(path, { throwIfNoEntry: false });
    return found?.isFile() && found.size <= LARGEST_FILE ? readFileSync(path) : undefined;
  },
  list(folder) {
    return statSync(folder, { throwIfNoEntry: false })?.isDirectory() ? readdirSync(folder) : undefined;
  },
};
