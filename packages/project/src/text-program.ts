/*
 * A vendor's program kept as its files, byte for byte: it lives in the cell, runs from its text, and its taught points
 * are patched in place. Nothing of it is converted.
 */

/** How the bytes of a file stand in its `text`, and how a person is to see them. */
export type TextEncoding = "utf-8" | "latin-1" | "shift-jis";

export interface TextFile {
  readonly name: string;
  /** "utf-8" when left out. */
  readonly encoding?: TextEncoding;
  /**
   * The whole file with its own line ends. Of "utf-8" the characters; of the others one character U+0000 … U+00FF a
   * byte, so that every byte comes back and patches count bytes.
   */
  readonly text: string;
}

export interface TextProgram {
  readonly format: "twincell.text-program";
  readonly version: 1;
  readonly name: string;
  /** Id of the robot it was written for. */
  readonly robot: string;
  /** Id of the vendor language: "krl", "rapid", "urscript", … */
  readonly language: string;
  /** Name of the file that is run. */
  readonly main: string;
  readonly files: readonly TextFile[];
}

export const TEXT_PROGRAM_FORMAT = "twincell.text-program";

/**
 * A file as a cell keeps it. Bytes that are UTF-8 are kept as characters. Others are Shift-JIS when they read as such
 * with at least one pair that begins with 0x81 … 0x9f (control codes in Latin-1, most kanji in Shift-JIS), else
 * Latin-1; the guess only decides how they are shown, for the bytes are kept.
 */
export function textFileOf(name: string, bytes: Uint8Array): TextFile {
  const text = utf8Text(bytes);
  if (text !== undefined) return { name, text };
  return { name, encoding: isShiftJis(bytes) ? "shift-jis" : "latin-1", text: byteText(bytes) };
}

/** The bytes of a kept file: those it was made of, where nothing was patched. */
export function bytesOfTextFile({ encoding = "utf-8", text }: TextFile): Uint8Array {
  if (encoding === "utf-8") return utf8Bytes(text);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** The same program with the text of one file replaced; the very same program when nothing differs. */
export function withFileText(program: TextProgram, name: string, text: string): TextProgram {
  const files = program.files.map(file => (file.name === name && file.text !== text ? { ...file, text } : file));
  return files.every((file, i) => file === program.files[i]) ? program : { ...program, files };
}

/** The file that is run; a program without its main file does not open. */
export const mainFileOf = (program: TextProgram): TextFile => {
  const file = program.files.find(each => each.name === program.main);
  if (file === undefined) throw new RangeError(`${program.name} has no file called ${program.main}.`);
  return file;
};

function byteText(bytes: Uint8Array): string {
  let text = "";
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return text;
}

/** Strict: undefined when a byte is not UTF-8. A byte order mark stays as U+FEFF. */
function utf8Text(bytes: Uint8Array): string | undefined {
  const parts: string[] = [];
  let units: number[] = [];
  for (let i = 0; i < bytes.length; ) {
    const first = bytes[i]!;
    const length = first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
    if (length === 0 || i + length > bytes.length) return undefined;
    let code = length === 1 ? first : first & (0xff >> (length + 1));
    for (let k = 1; k < length; k++) {
      const next = bytes[i + k]!;
      if ((next & 0xc0) !== 0x80) return undefined;
      code = (code << 6) | (next & 0x3f);
    }
    const least = length === 3 ? 0x800 : length === 4 ? 0x10000 : 0;
    if (code < least || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return undefined;
    units.push(code);
    i += length;
    if (units.length === 4096) {
      parts.push(String.fromCodePoint(...units));
      units = [];
    }
  }
  parts.push(String.fromCodePoint(...units));
  return parts.join("");
}

function utf8Bytes(text: string): Uint8Array {
  const bytes: number[] = [];
  for (const character of text) {
    const code = character.codePointAt(0)!;
    if (code < 0x80) bytes.push(code);
    else if (code < 0x800) bytes.push(0xc0 | (code >> 6), 0x80 | (code & 0x3f));
    else if (code < 0x10000) bytes.push(0xe0 | (code >> 12), 0x80 | ((code >> 6) & 0x3f), 0x80 | (code & 0x3f));
    else
      bytes.push(0xf0 | (code >> 18), 0x80 | ((code >> 12) & 0x3f), 0x80 | ((code >> 6) & 0x3f), 0x80 | (code & 0x3f));
  }
  return Uint8Array.from(bytes);
}

/**
 * Every byte is ASCII, a half-width kana, or half of a pair, and at least one pair begins with 0x81 … 0x9f (JIS X 0208
 * annex 1).
 */
function isShiftJis(bytes: Uint8Array): boolean {
  let pairs = 0;
  for (let i = 0; i < bytes.length; i++) {
    const first = bytes[i]!;
    if (first < 0x80 || (first >= 0xa1 && first <= 0xdf)) continue;
    const second = bytes[++i];
    const leads = (first >= 0x81 && first <= 0x9f) || (first >= 0xe0 && first <= 0xfc);
    if (!leads || second === undefined || second < 0x40 || second === 0x7f || second > 0xfc) return false;
    if (first <= 0x9f) pairs++;
  }
  return pairs > 0;
}
