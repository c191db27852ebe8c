import { mkdir, rename, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";

/** Writes a set of files so that none is ever half there: all to names beside them first, then renamed. */
export async function writeWhole(folder: string, files: readonly { readonly name: string; readonly text: string }[]): Promise<string[]> {
  await mkdir(folder, { recursive: true });
  const paths = files.map(file => join(folder, file.name));
  await Promise.all(files.map((file, i) => writeFile(`${paths[i]!}.part`, file.text)));
  for (const path of paths) await rename(`${path}.part`, path);
  return paths;
}

/** Writes one file whole. */
export const writeOne = async (path: string, text: string): Promise<void> => {
  await mkdir(dirname(path), { recursive: true });
  await writeFile(`${path}.part`, text);
  await rename(`${path}.part`, path);
};
