import { mkdir, rename, rm, stat, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { UseFault } from "./usage.ts";

/** Writes a set of files so that none is ever half there: all to names beside them first, then renamed. */
export async function writeWhole(
  folder: string,
  files: readonly { readonly name: string; readonly text: string }[],
): Promise<string[]> {
  const paths = files.map(file => join(folder, file.name));
  const parts = paths.map(path => `${path}.part`);
  try {
    await mkdir(folder, { recursive: true });
    for (const path of paths)
      if (await isFolder(path)) throw new UseFault(`${path} cannot be written: it is a folder.`);
    await Promise.all(files.map((file, i) => writeFile(parts[i]!, file.text)));
    for (const [i, path] of paths.entries()) await rename(parts[i]!, path);
  } catch (problem) {
    await Promise.allSettled(parts.map(part => rm(part, { force: true })));
    throw notWritten(folder, problem);
  }
  return paths;
}

/** Writes one file whole. */
export const writeOne = async (path: string, text: string | Uint8Array): Promise<void> => {
  const part = `${path}.part`;
  try {
    await mkdir(dirname(path), { recursive: true });
    if (await isFolder(path)) throw new UseFault(`${path} cannot be written: it is a folder.`);
    await writeFile(part, text);
    await rename(part, path);
  } catch (problem) {
    await Promise.allSettled([rm(part, { force: true })]);
    throw notWritten(path, problem);
  }
};

const isFolder = async (path: string): Promise<boolean> => {
  try {
    return (await stat(path)).isDirectory();
  } catch (problem) {
    if (codeOf(problem) === "ENOENT") return false;
    throw problem;
  }
};

const codeOf = (problem: unknown): string =>
  problem instanceof Error && "code" in problem ? String(problem.code) : "";

const WHY: Readonly<Record<string, string>> = {
  EACCES: "this user may not write there",
  EPERM: "this user may not write there",
  EROFS: "the disk can only be read",
  ENOSPC: "the disk is full",
  ENOTDIR: "a part of the path is a file, not a folder",
  EEXIST: "a part of the path is a file, not a folder",
  ENAMETOOLONG: "the name is too long",
};

/** What keeps a file from being written is the user's to put right; everything else stays what it is. */
function notWritten(path: string, problem: unknown): unknown {
  const code = codeOf(problem);
  return problem instanceof UseFault || !/^E[A-Z]+$/.test(code)
    ? problem
    : new UseFault(`${path} cannot be written: ${WHY[code] ?? code}.`, "Nothing was written.");
}
