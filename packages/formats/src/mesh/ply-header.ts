import { Refusal } from "../refusal.ts";
import { shorten } from "../xml.ts";
import { latin1 } from "./text.ts";

const SIZES = { int8: 1, uint8: 1, int16: 2, uint16: 2, int32: 4, uint32: 4, float32: 4, float64: 8 } as const;
export type PlyNumber = keyof typeof SIZES;
export const sizeOf = (type: PlyNumber): number => SIZES[type];

/** Names of number types: those of the first format text and those with their width. */
const TYPES: Readonly<Record<string, PlyNumber>> = {
  char: "int8",
  uchar: "uint8",
  short: "int16",
  ushort: "uint16",
  int: "int32",
  uint: "uint32",
  float: "float32",
  double: "float64",
  int8: "int8",
  uint8: "uint8",
  int16: "int16",
  uint16: "uint16",
  int32: "int32",
  uint32: "uint32",
  float32: "float32",
  float64: "float64",
};

/** One value of an element; with `count`, a list that says its length first in that type. */
export interface PlyProperty {
  readonly name: string;
  readonly type: PlyNumber;
  readonly count?: PlyNumber;
}
export interface PlyElement {
  readonly name: string;
  readonly count: number;
  readonly properties: readonly PlyProperty[];
}
export interface PlyHeader {
  readonly encoding: "ascii" | "binary_little_endian" | "binary_big_endian";
  readonly elements: readonly PlyElement[];
  /** Where the data begin [byte], and how many lines stand before them. */
  readonly end: number;
  readonly lines: number;
}

const LONGEST_HEADER = 65_536;

/** What the head of a PLY file says is in it. @throws {Refusal} with the line that was not understood. */
export function plyHeader(bytes: Uint8Array): PlyHeader {
  const text = latin1(bytes.subarray(0, LONGEST_HEADER));
  if (!/^ply\s/.test(text)) throw new Refusal("The file does not begin with “ply”: it is no PLY.");
  const close = /\nend_header[ \t]*(\r\n|\n|\r)/.exec(text);
  if (!close) throw new Refusal(`The header of the PLY does not end within ${LONGEST_HEADER} bytes.`);
  const elements: { name: string; count: number; properties: PlyProperty[] }[] = [];
  const lines = text.slice(0, close.index).split("\n");
  let encoding: PlyHeader["encoding"] | undefined;
  lines.forEach((line, i) => {
    const [keyword = "", ...words] = line.trim().split(/\s+/);
    const at = i + 1;
    if (keyword === "format") encoding = encodingOf(words[0], at);
    else if (keyword === "element")
      elements.push({ name: words[0] ?? "", count: countOf(words[1], at), properties: [] });
    else if (keyword === "property") {
      const element = elements.at(-1);
      if (!element) throw new Refusal("A property stands before any element.", at);
      element.properties.push(
        words[0] === "list"
          ? { name: words[3] ?? "", count: typeOf(words[1], at), type: typeOf(words[2], at) }
          : { name: words[1] ?? "", type: typeOf(words[0], at) },
      );
    } else if (!["ply", "comment", "obj_info", ""].includes(keyword))
      throw new Refusal(`“${shorten(keyword)}” is no word of a PLY header.`, at);
  });
  if (encoding === undefined) throw new Refusal("The header does not say whether the data are text or binary.");
  return { encoding, elements, end: close.index + close[0].length, lines: lines.length + 1 };
}

function encodingOf(word: string | undefined, line: number): PlyHeader["encoding"] {
  if (word === "ascii" || word === "binary_little_endian" || word === "binary_big_endian") return word;
  throw new Refusal(`“${shorten(word ?? "")}” is no encoding of a PLY.`, line);
}
function countOf(word: string | undefined, line: number): number {
  if (word === undefined || !/^[0-9]{1,10}$/.test(word))
    throw new Refusal(`“${shorten(word ?? "")}” stands where the number of elements is expected.`, line);
  return Number(word);
}
function typeOf(word: string | undefined, line: number): PlyNumber {
  const type = Object.hasOwn(TYPES, word ?? "") ? TYPES[word ?? ""] : undefined;
  if (type === undefined) throw new Refusal(`“${shorten(word ?? "")}” is no number type of a PLY.`, line);
  return type;
}
