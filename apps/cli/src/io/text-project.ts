import { readdir, readFile, stat } from "node:fs/promises";
import { basename, dirname, join, relative, sep } from "node:path";
import { inflateRawSync } from "node:zlib";
import type { Dialect, TextFault } from "@twincell/core";
import { readZip } from "@twincell/formats";
import { DIALECTS, dialectById, joinFiles, mainOf, type JoinedText } from "@twincell/languages";
import { openDocument, selectedText, textFileOf, type CellDocument, type TextFile } from "@twincell/project";
import { dialectOf } from "./dialect.ts";
import { readText } from "./files.ts";
import { UseFault } from "./usage.ts";

/** A vendor's program of one or several files, as it is executed. */
export interface TextProject {
  readonly dialect: Dialect;
  readonly files: readonly TextFile[];
  readonly joined: JoinedText;
  /** The path or file name that a line of the joined text stands in. */
  placeOf(line: number): { readonly path: string; readonly line: number };
  /** The cell it was kept in, when it comes from one. */
  readonly cell?: CellDocument;
}

/**
 * The program of these paths: files, folders of files, or a cell whose selected program is a text. The siblings of a
 * file are found beside it: those of the same name with another ending of the language (program.src has its
 * program.dat), and what else of the controller's backup around it the program names. A ZIP archive stands for the one
 * program in it, and is a folder in a path: backup.zip/R1/weld.src.
 */
export async function textProject(paths: readonly string[], language: string | undefined): Promise<TextProject> {
  const [first] = paths;
  if (first === undefined) throw new UseFault("FILE is missing.", "Give the path of a program text.");
  if (/\.json$/i.test(first)) return fromCell(first);
  if (first === "-") {
    const dialect = dialectOf("dialect", language);
    const file: TextFile = { name: "-", text: await readText("-") };
    return project(dialect, [{ path: "-", file }], "-");
  }
  const archives = new Archives();
  const whole = (await Promise.all(paths.map(path => filesOf(path, archives)))).flat();
  const [named] = whole;
  if (named === undefined) throw new UseFault(`${first} holds no file.`);
  // The file whose ending says the language: a program rather than its data.
  const program = whole.find(path => paths.includes(path) && !/\.dat$/i.test(path));
  const known = whole.find(path => DIALECTS.some(each => speaks(each, path)));
  const dialect = dialectOf("dialect", language, program ?? known ?? named);
  const all = new Set(whole.filter(path => speaks(dialect, path) || paths.includes(path)));
  for (const archive of paths.filter(path => archives.has(path))) onlyProgram(archive, [...all]);
  for (const path of [...all]) for (const sibling of await siblingsOf(path, dialect, archives)) all.add(sibling);
  const around = await aroundOf([...all][0]!, dialect, archives);
  const nameOf = (path: string): string =>
    around === undefined || !path.startsWith(around.root) ? basename(path) : relative(around.root, path);
  const read = await Promise.all(
    [...all].map(async path => ({ path, file: textFileOf(nameOf(path), await bytesOf(path, archives)) })),
  );
  for (const path of around?.paths ?? []) {
    if (all.has(path)) continue;
    const file = await textBeside(path, nameOf(path), archives);
    if (file !== undefined) read.push({ path, file });
  }
  const twice = read.find(({ file }, i) => read.findIndex(each => each.file.name === file.name) < i);
  if (twice) throw new UseFault(`Two files are called ${twice.file.name}.`, "Give the files of one program.");
  const given = read.filter(({ path }) => paths.includes(path)).map(({ file }) => file);
  const main =
    mainOf(dialect, given) ??
    mainOf(
      dialect,
      read.map(({ file }) => file),
    ) ??
    read[0]!.file;
  return project(dialect, read, main.name);
}

/** The message for a text that cannot be executed: the file and line of its first fault. */
export function projectFault({ placeOf }: TextProject, faults: readonly TextFault[]): UseFault {
  const [fault] = faults;
  const { path, line } = placeOf(fault?.line ?? 1);
  return new UseFault(
    `${path}, line ${line}, column ${fault?.column ?? 0}: ${fault?.sentence ?? "The text cannot be read."}`,
    faults.length > 1 ? `${faults.length - 1} more of the kind.` : "",
  );
}

function project(
  dialect: Dialect,
  read: readonly { readonly path: string; readonly file: TextFile }[],
  main: string,
  cell?: CellDocument,
): TextProject {
  const files = read.map(({ file }) => file);
  const joined = joinFiles(dialect, files, main);
  return {
    dialect,
    files,
    joined,
    placeOf: line => {
      const place = joined.place(line);
      return { path: read[place.file]?.path ?? main, line: place.line };
    },
    ...(cell === undefined ? {} : { cell }),
  };
}

async function fromCell(path: string): Promise<TextProject> {
  const opened = openDocument(await readText(path));
  if (opened.kind !== "opened")
    throw new UseFault(
      `${path}: ${opened.kind === "not-a-cell" ? (opened.why[0] ?? "This is not a saved cell.") : `version ${opened.version} is newer than this release reads.`}`,
    );
  const text = selectedText(opened.document);
  const dialect = text && dialectById(text.language);
  if (!text || !dialect)
    throw new UseFault(
      text
        ? `${path}: there is no language "${text.language}".`
        : `${path}: the selected program "${opened.document.program}" is of steps, not a vendor's text.`,
      text ? "" : "Leave --as-text out, or select the text in the studio.",
    );
  return project(
    dialect,
    text.files.map(file => ({ path: file.name, file })),
    text.main,
    opened.document,
  );
}

const speaks = (dialect: Dialect, path: string): boolean =>
  dialect.extensions.some(each => path.toLowerCase().endsWith(each.toLowerCase()));

/** The archives that paths lead into, each read once. */
class Archives {
  private readonly read = new Map<string, ReadonlyMap<string, Uint8Array>>();

  has(path: string): boolean {
    return this.read.has(path);
  }

  /** Opens the archive that a path is or leads into; undefined where it does neither. */
  async open(path: string): Promise<{ readonly archive: string; readonly inside: string } | undefined> {
    const [, archive, inside = ""] = /^(.*?\.zip)(?:[/\\](.*))?$/i.exec(path) ?? [];
    if (archive === undefined || !(await stat(archive).catch(() => undefined))?.isFile()) return undefined;
    if (!this.read.has(archive)) {
      const answer = readZip(await readFile(archive), (packed, size) =>
        inflateRawSync(packed, { maxOutputLength: size + 1 }),
      );
      if (answer.kind !== "read") throw new UseFault(`${archive}: ${answer.sentence}`);
      this.read.set(archive, answer.files);
    }
    return { archive, inside: inside.replaceAll("\\", "/") };
  }

  /** Paths of all files of an archive that was opened. */
  filesOf(archive: string): string[] {
    return [...(this.read.get(archive)?.keys() ?? [])].sort().map(inside => `${archive}/${inside}`);
  }

  bytesOf(archive: string, inside: string): Uint8Array | undefined {
    return this.read.get(archive)?.get(inside);
  }
}

/** An archive alone stands for the program in it: a backup of many wants one to be named. */
function onlyProgram(archive: string, files: readonly string[]): void {
  const programs = new Set(
    files.filter(path => path.startsWith(`${archive}/`)).map(path => path.replace(/\.[^./]*$/, "").toLowerCase()),
  );
  if (programs.size === 0) throw new UseFault(`${archive} holds no program of this language.`);
  if (programs.size === 1) return;
  const named = files.filter(path => path.startsWith(`${archive}/`) && !/\.dat$/i.test(path)).slice(0, 3);
  throw new UseFault(`${archive} holds ${programs.size} programs.`, `Name one of them, such as ${named.join(" or ")}.`);
}

async function filesOf(path: string, archives: Archives): Promise<string[]> {
  const packed = await archives.open(path);
  if (packed) {
    const { archive, inside } = packed;
    if (inside === "") return archives.filesOf(archive);
    if (!archives.bytesOf(archive, inside)) throw new UseFault(`There is no file ${inside} in ${archive}.`);
    return [path];
  }
  const found = await stat(path).catch(() => undefined);
  if (found === undefined) throw new UseFault(`There is no file ${path}.`);
  if (!found.isDirectory()) return [path];
  const names = await readdir(path);
  return names.sort().map(name => join(path, name));
}

async function siblingsOf(path: string, dialect: Dialect, archives: Archives): Promise<string[]> {
  const stemOf = (name: string): string =>
    basename(name)
      .replace(/\.[^.]*$/, "")
      .toLowerCase();
  const packed = await archives.open(path);
  const beside = packed
    ? archives.filesOf(packed.archive).filter(each => dirname(each) === dirname(path))
    : (await readdir(dirname(path)).catch(() => [])).map(name => join(dirname(path), name));
  return beside.filter(
    each => stemOf(each) === stemOf(path) && speaks(dialect, each) && each !== path && each !== join(path),
  );
}

/** Larger files, and more of them, are no program's. */
const MOST_BYTES = 2_000_000;
const MOST_AROUND = 2000;

/**
 * Where the project of a file begins, and its files of the language: the folder R1 of a KUKA controller, the task of an
 * ABB one, the folder of a file elsewhere. Which of them are loaded is decided by what the program names.
 */
async function aroundOf(
  path: string,
  dialect: Dialect,
  archives: Archives,
): Promise<{ readonly root: string; readonly paths: readonly string[] } | undefined> {
  if (!WITH_PROJECTS.has(dialect.id) || path === "-") return undefined;
  const parts = path.split(/[/\\]/);
  const inR1 = parts.findLastIndex(part => /^R1$/i.test(part));
  const isModule = /^(?:PROG|SYS)MOD$/i.test(basename(dirname(path)));
  const root =
    dialect.id === "krl" && inR1 > 0
      ? parts.slice(0, inR1 + 1).join(sep)
      : dialect.id === "rapid" && isModule
        ? dirname(dirname(path))
        : dirname(path);
  const packed = await archives.open(root);
  const all = packed
    ? archives.filesOf(packed.archive).filter(each => each.startsWith(root))
    : (await readdir(root, { recursive: root !== dirname(path) }).catch(() => [])).map(name => join(root, name));
  return {
    root,
    paths: all
      .filter(each => speaks(dialect, each))
      .sort()
      .slice(0, MOST_AROUND),
  };
}

const WITH_PROJECTS: ReadonlySet<string> = new Set(["krl", "rapid", "urscript", "val3"]);

/** A file that nobody named: one that is too large, binary or cannot be read is none of the program. */
async function textBeside(path: string, name: string, archives: Archives): Promise<TextFile | undefined> {
  const packed = await archives.open(path);
  const bytes = packed
    ? archives.bytesOf(packed.archive, packed.inside)
    : (await stat(path).catch(() => undefined))?.isFile() === true
      ? await readFile(path).catch(() => undefined)
      : undefined;
  if (bytes === undefined || bytes.length > MOST_BYTES || bytes.subarray(0, 4096).includes(0)) return undefined;
  return textFileOf(name, bytes);
}

async function bytesOf(path: string, archives: Archives): Promise<Uint8Array> {
  const packed = await archives.open(path);
  const bytes =
    (packed && archives.bytesOf(packed.archive, packed.inside)) ??
    (await readFile(path).catch((problem: unknown) => {
      throw new UseFault(`${path} cannot be read: ${(problem as Error).message}.`);
    }));
  if (bytes.subarray(0, 4096).includes(0))
    throw new UseFault(`${path} is a binary program, not a text.`, "Export it as text on the controller.");
  return bytes;
}
