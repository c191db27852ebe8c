import { utf8 } from "../utf8.ts";
import { folderOf, joinPath, nameOf, normalPath, type FileSource } from "./source.ts";

/** How many folders above a file are searched for packages and for files that were moved together with it. */
const HIGHEST = 8;

export interface FoundFile {
  readonly kind: "found";
  readonly path: string;
  /** Said when the file was not where its reference says: another spelling, a moved folder. */
  readonly note?: string;
}
export interface MissingFile {
  readonly kind: "missing";
  readonly sentence: string;
}

/**
 * The file a reference means: `package://name/path`, `model://name/path`, `file:///path`, a path with `/` or `\`,
 * absolute or beside the file that names it. Where it is not there: the same with other capital letters, then its last
 * parts in a folder above, so that a robot moved or unpacked together with its meshes is whole again.
 *
 * @param from  path of the file that holds the reference.
 */
export function resolveFile(reference: string, from: string, files: FileSource): FoundFile | MissingFile {
  const scheme = /^([a-z][a-z0-9+.-]+):\/\//i.exec(reference)?.[1]?.toLowerCase();
  let rest = (scheme ? reference.slice(scheme.length + 3) : reference).replaceAll("\\", "/");
  // A folder that was not found stands in what xacro puts together: file://package://name/….
  if (scheme === "file" && rest.startsWith("package://")) return resolveFile(rest, from, files);
  if (scheme !== undefined && !["package", "model", "file"].includes(scheme))
    return {
      kind: "missing",
      sentence: `${reference} is not a file here: only package://, file:// and plain paths are opened.`,
    };
  if (scheme === "file" && rest.includes("%")) rest = unescaped(rest);
  const here = folderOf(from);
  if (scheme === "package" || scheme === "model") {
    const [name = "", ...parts] = rest.split("/");
    const folder = findPackage(name, from, files);
    if (folder !== undefined) {
      const found = existing(joinPath(folder, parts.join("/")), files);
      if (found) return told(found, reference);
    }
    const moved = inFoldersAbove(parts, here, files) ?? inFoldersAbove([name, ...parts], here, files);
    if (moved !== undefined) return { kind: "found", path: moved, note: `${reference} was found as ${moved}.` };
    return {
      kind: "missing",
      sentence:
        folder === undefined
          ? `${reference} is missing: the package ${name} is not beside the file.`
          : `${reference} is missing in ${folder}.`,
    };
  }
  const written = rest.startsWith("/") || /^[A-Za-z]:/.test(rest) ? rest : joinPath(here, rest);
  const plain = existing(written, files) ?? existing(rest, files);
  if (plain) return told(plain, reference);
  const moved = inFoldersAbove(rest.split("/"), here, files);
  return moved === undefined
    ? { kind: "missing", sentence: `${reference} is missing.` }
    : { kind: "found", path: moved, note: `${reference} was found as ${moved}.` };
}

/**
 * The folder of a ROS package: one above the file, or beside one above it, that is called so or whose package.xml says
 * so.
 */
export function findPackage(name: string, from: string, files: FileSource): string | undefined {
  if (name === "" || name === "." || name === "..") return undefined;
  let folder = folderOf(from);
  for (let up = 0; up < HIGHEST; up++, folder = folderOf(folder)) {
    if (nameOf(folder) === name || packageName(folder, files) === name) return folder;
    const inside = files.list(folder) ?? [];
    if (inside.includes(name) && files.list(joinPath(folder, name))) return joinPath(folder, name);
    for (const child of inside)
      if (packageName(joinPath(folder, child), files) === name) return joinPath(folder, child);
    if (folder === "" || folder === "/") break;
  }
  return undefined;
}

function packageName(folder: string, files: FileSource): string | undefined {
  const bytes = files.read(joinPath(folder, "package.xml"));
  return bytes && /<name>\s*([^<\s]+)\s*<\/name>/.exec(utf8(bytes.subarray(0, 65_536)))?.[1];
}

interface Existing {
  readonly path: string;
  readonly otherCase: boolean;
}

/** The path as it is written, else folder by folder with other capital letters. */
function existing(written: string, files: FileSource): Existing | undefined {
  const path = normalPath(written);
  if (path === undefined) return undefined;
  if (files.read(path)) return { path, otherCase: false };
  const parts = path.split("/").filter(part => part !== "");
  let at = path.startsWith("/") ? "/" : "";
  for (const part of parts) {
    const next = joinPath(at, part);
    const names = files.list(at) ?? [];
    if (names.includes(part) || (names.length === 0 && files.list(next))) {
      at = next;
      continue;
    }
    const like = names.find(name => name.toLowerCase() === part.toLowerCase());
    if (like === undefined) return undefined;
    at = joinPath(at, like);
  }
  return files.read(at) ? { path: at, otherCase: at !== path } : undefined;
}

const told = ({ path, otherCase }: Existing, reference: string): FoundFile =>
  otherCase ? { kind: "found", path, note: `${reference} is spelt ${path}.` } : { kind: "found", path };

/**
 * Longest tail first: `a/b/c.stl`, then `b/c.stl`, then `c.stl`, each beside the file and in the two folders above it.
 */
function inFoldersAbove(parts: readonly string[], here: string, files: FileSource): string | undefined {
  const kept = parts.filter(part => part !== "" && part !== "." && part !== ".." && !/^[A-Za-z]:$/.test(part));
  for (let first = Math.max(0, kept.length - HIGHEST); first < kept.length; first++) {
    let folder = here;
    for (let up = 0; up < 3; up++, folder = folderOf(folder)) {
      const found = existing(joinPath(folder, kept.slice(first).join("/")), files);
      if (found) return found.path;
      if (folder === "" || folder === "/") break;
    }
  }
  return undefined;
}

/** `%20` and its kin; what is none of them stays. */
const unescaped = (text: string): string =>
  text.replace(/%([0-7][0-9a-f])/gi, (_, hex: string) => String.fromCharCode(Number.parseInt(hex, 16)));
