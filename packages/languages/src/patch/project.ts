import type { Dialect } from "@twincell/core";
import { neededFiles } from "./needed.ts";
import type { PatchFile } from "./points.ts";

/** What a controller executes of a project, as one text, and where each of its lines stands. */
export interface JoinedText {
  readonly text: string;
  /** File (index) and line of a line of the joined text; both line numbers count from 1. */
  place(line: number): { readonly file: number; readonly line: number };
  /** The line of the joined text where a line of a file stands; undefined for a file that is not executed. */
  joined(file: number, line: number): number | undefined;
}

const baseOf = (name: string): string =>
  name
    .replace(/^.*[/\\]/, "")
    .replace(/\.[^.]*$/, "")
    .toLowerCase();
const endingOf = (name: string): string => (/\.[^./\\]*$/.exec(name)?.[0] ?? "").toLowerCase();

/** Lists of modules: they name what is loaded and hold no statement. */
const LISTS = new Set([".pgf"]);

const speaks = (dialect: Pick<Dialect, "extensions">, name: string): boolean =>
  !LISTS.has(endingOf(name)) &&
  dialect.extensions.some(each => endingOf(name) === (each.startsWith(".") ? each : `.${each}`).toLowerCase());

const folderOf = (name: string): string => /^(.*[/\\])?/.exec(name)![0];
/** Data that are read right behind their program. */
const isOwnData = (name: string, main: string): boolean =>
  baseOf(name) === baseOf(main) && folderOf(name) === folderOf(main);

/** Files that only hold data: never the one that is run. */
const DATA = new Set([".dat", ".sys", ".sysx", ".dtx", ".pts", ".va"]);

/**
 * The file that is run: of those with statements the one whose name no other mentions, the first of several. Undefined
 * when none is of the language.
 */
export function mainOf(dialect: Pick<Dialect, "extensions">, files: readonly PatchFile[]): PatchFile | undefined {
  const programs = files.filter(file => speaks(dialect, file.name) && !DATA.has(endingOf(file.name)));
  const called = (file: PatchFile): boolean => {
    const name = new RegExp(String.raw`\b${baseOf(file.name).replace(/[^\w]/g, ".")}\b`, "i");
    return programs.some(other => other !== file && name.test(other.text));
  };
  return programs.find(file => !called(file)) ?? programs[0];
}

/**
 * The main file, its own data list behind it, then the other files of the language that it needs, in their order: what
 * is loaded together.
 */
export function joinFiles(
  dialect: Pick<Dialect, "extensions"> & Partial<Pick<Dialect, "id">>,
  files: readonly PatchFile[],
  main: string,
): JoinedText {
  const needed = new Set(neededFiles(dialect.id, files, main));
  const rank = (file: PatchFile): number =>
    file.name === main ? 0 : isOwnData(file.name, main) ? 1 : DATA.has(endingOf(file.name)) ? 3 : 2;
  const order = files
    .map((file, index) => ({ file, index }))
    .filter(({ file }) => file.name === main || (speaks(dialect, file.name) && needed.has(file)))
    .sort((a, b) => rank(a.file) - rank(b.file) || a.index - b.index);
  let text = "";
  let line = 1;
  const parts: { readonly index: number; readonly first: number; readonly lines: number }[] = [];
  for (const { file, index } of order) {
    const whole = /[\r\n]$/.test(file.text) || file.text === "" ? file.text : `${file.text}\n`;
    const lines = (whole.match(/\r\n|\n|\r/g) ?? []).length;
    parts.push({ index, first: line, lines });
    text += whole;
    line += lines;
  }
  return {
    text,
    place(at) {
      const part = parts.findLast(({ first }) => first <= at) ?? parts[0];
      return part === undefined ? { file: 0, line: at } : { file: part.index, line: at - part.first + 1 };
    },
    joined(file, at) {
      const part = parts.find(({ index }) => index === file);
      return part === undefined ? undefined : part.first + at - 1;
    },
  };
}
