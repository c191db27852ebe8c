/**
 * Where a reader gets the files that a file names. Paths have forward slashes; nothing else is ever opened.
 * A folder dropped into the page, an unpacked archive and a disk all fit behind it.
 */
export interface FileSource {
  /** The bytes of a file, or undefined where there is none. They belong to the source: not changed by the reader. */
  read(path: string): Uint8Array | undefined;
  /** Names in a folder, undefined where there is no such folder. With it other spellings and packages are found. */
  list(folder: string): readonly string[] | undefined;
}

/** Files held in memory, by path. */
export function filesInMemory(files: ReadonlyMap<string, Uint8Array>): FileSource {
  const folders = new Map<string, Set<string>>([["", new Set()]]);
  const byPath = new Map<string, Uint8Array>();
  for (const [path, bytes] of files) {
    const normal = normalPath(path);
    if (normal === undefined || normal === "") continue;
    byPath.set(normal, bytes);
    for (let at = normal; at !== ""; at = folderOf(at)) {
      const folder = folderOf(at);
      const names = folders.get(folder) ?? new Set();
      names.add(at.slice(folder === "" || folder === "/" ? folder.length : folder.length + 1));
      folders.set(folder, names);
      if (folder === "/") break;
    }
  }
  return {
    read: path => byPath.get(normalPath(path) ?? ""),
    list: folder => {
      const names = folders.get(normalPath(folder) ?? "?");
      return names && [...names].sort();
    },
  };
}

/** Forward slashes, no `.`, no `..`; undefined when it climbs above its beginning. `C:\x` becomes `C:/x`. */
export function normalPath(path: string): string | undefined {
  const parts: string[] = [];
  const slashed = path.replaceAll("\\", "/");
  for (const part of slashed.split("/")) {
    if (part === "" || part === ".") continue;
    if (part === ".." && parts.pop() === undefined) return undefined;
    if (part !== "..") parts.push(part);
  }
  return (slashed.startsWith("/") ? "/" : "") + parts.join("/");
}

/** The folder a path lies in: "" for a name alone, "/" at the root. */
export function folderOf(path: string): string {
  const slash = path.lastIndexOf("/");
  return slash < 0 ? "" : slash === 0 ? "/" : path.slice(0, slash);
}

export const joinPath = (folder: string, name: string): string =>
  folder === "" ? name : folder.endsWith("/") ? folder + name : `${folder}/${name}`;
export const nameOf = (path: string): string => path.slice(path.lastIndexOf("/") + 1);
