import type { FileAt } from "../../runtime/mesh-import.ts";

/** More files than this of a dropped folder are left where they are. */
const MOST_FILES = 5000;

/** The files of a drop, with those in dropped folders. Must be called while the drop is being handled. */
export function droppedFiles(transfer: DataTransfer | null): Promise<readonly FileAt[]> {
  const entries = [...(transfer?.items ?? [])].map(item => item.webkitGetAsEntry()).filter(entry => entry !== null);
  const plain = [...(transfer?.files ?? [])].map(file => ({ path: file.name, file }));
  if (!entries.some(entry => entry.isDirectory)) return Promise.resolve(plain);
  return filesIn(entries);
}

async function filesIn(entries: readonly FileSystemEntry[]): Promise<FileAt[]> {
  const found: FileAt[] = [];
  for (const entry of entries) {
    if (found.length >= MOST_FILES) break;
    if (isFile(entry)) {
      const file = await new Promise<File>((resolve, reject) => entry.file(resolve, reject));
      found.push({ path: entry.fullPath.replace(/^\//, ""), file });
    } else if (isFolder(entry)) found.push(...(await filesIn(await contentOf(entry))));
  }
  return found;
}

const isFile = (entry: FileSystemEntry): entry is FileSystemFileEntry => entry.isFile;
const isFolder = (entry: FileSystemEntry): entry is FileSystemDirectoryEntry => entry.isDirectory;

/** A browser hands a folder out in pieces; an empty one is the end. */
async function contentOf(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const all: FileSystemEntry[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return all;
    all.push(...some);
  }
}
