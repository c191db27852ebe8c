import type { PatchFile, TextPoint } from "./points.ts";

/** One replacement in a file; applied to the file it was made of. */
export interface TextEdit {
  readonly file: number;
  readonly start: number;
  readonly end: number;
  readonly text: string;
}

/** Digits that a touched-up point gets at least: a micrometre or a thousandth of a degree, and what turns as finely. */
const MIN_DECIMALS = { millimetres: 3, fraction: 6 } as const;

/**
 * The edits that give a point new numbers. Fields that the point does not have are not added; a number that says the
 * same to its own last digit is left as it stands. Decimals are kept and never fewer than a touch-up needs; a field set
 * flush right keeps its width; a binary status stays binary.
 *
 * @param values  by key of the fields, as the language's emitter writes them.
 * @param fine  whether lengths are metres and angles radians or parts of a quaternion.
 */
export function editsOf(
  files: readonly PatchFile[],
  point: TextPoint,
  values: Readonly<Record<string, string>>,
  fine: (key: string) => boolean,
): TextEdit[] {
  const { file } = point.value;
  const { text } = files[file]!;
  return point.fields.flatMap(({ key, start, end }): TextEdit[] => {
    const wanted = values[key];
    const old = text.slice(start, end);
    if (wanted === undefined) return [];
    const next = key === "CONFIG" ? configuration(old, wanted) : number(old, wanted.trim(), fine(key));
    return next === old ? [] : [{ file, start, end, text: next }];
  });
}

const configuration = (old: string, wanted: string): string =>
  old.replace(/\s+/g, "") === wanted.replace(/\s+/g, "") ? old : wanted;

/** A number that is written in bits or hexadecimal digits, in its own way. */
function bitsOf(old: string, wanted: string): string | undefined {
  const written = /^'([BH])([0-9A-F]+)'$/i.exec(old);
  if (written === null) return undefined;
  const [, letter, digits] = written as unknown as [string, string, string];
  const radix = letter.toUpperCase() === "B" ? 2 : 16;
  if (Number.parseInt(digits, radix) === Number(wanted)) return old;
  return `'${letter}${Number(wanted).toString(radix).toUpperCase().padStart(digits.length, "0")}'`;
}

function number(old: string, wanted: string, fine: boolean): string {
  const bits = bitsOf(old, wanted);
  if (bits !== undefined) return bits;
  const digits = old.trim();
  const value = Number(wanted);
  const whole = !/[.eE]/.test(wanted) && !/[.eE]/.test(digits);
  if (whole && Number(digits) === value) return old;
  const own = /[eE]/.test(digits) ? 0 : (/\.(\d*)$/.exec(digits)?.[1]?.length ?? 0);
  const decimals =
    whole && !/\./.test(wanted) ? 0 : Math.max(own, fine ? MIN_DECIMALS.fraction : MIN_DECIMALS.millimetres);
  // What is right to the last digit that the emitter knows is not touched: rounding moves nothing.
  const known = /\.(\d*)$/.exec(wanted)?.[1]?.length ?? 0;
  if (Math.abs(Number(digits) - value) <= 0.5 * 10 ** -Math.max(known, decimals)) return old;
  const said = value.toFixed(decimals);
  const next = Number(said) === 0 ? said.replace("-", "") : said;
  return next.padStart(old.length - digits.length > 0 ? old.length : 0);
}

/** The files with the edits applied; files without one are the very same. */
export function applyEdits<F extends PatchFile>(files: readonly F[], edits: readonly TextEdit[]): F[] {
  return files.map((file, index) => {
    const own = edits.filter(edit => edit.file === index).sort((a, b) => a.start - b.start);
    if (own.length === 0) return file;
    let text = "";
    let at = 0;
    for (const edit of own) {
      text += file.text.slice(at, edit.start) + edit.text;
      at = edit.end;
    }
    return { ...file, text: text + file.text.slice(at) };
  });
}
