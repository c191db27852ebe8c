import { asciiText } from "../../parser/index.ts";

const LENGTH = 15;
/** Words of the language that a variable must not be called. */
const RESERVED = new Set([
  "above",
  "accel",
  "all",
  "and",
  "any",
  "appro",
  "appros",
  "attach",
  "auto",
  "base",
  "below",
  "break",
  "by",
  "call",
  "case",
  "close",
  "closei",
  "coarse",
  "cpoff",
  "cpon",
  "decompose",
  "delay",
  "depart",
  "departs",
  "dest",
  "detach",
  "disable",
  "do",
  "drive",
  "duration",
  "else",
  "enable",
  "end",
  "exit",
  "false",
  "fine",
  "flip",
  "for",
  "frame",
  "global",
  "goto",
  "halt",
  "here",
  "if",
  "inverse",
  "lefty",
  "local",
  "mod",
  "move",
  "moves",
  "movest",
  "movet",
  "multiple",
  "noflip",
  "nonull",
  "nooverlap",
  "not",
  "null",
  "of",
  "off",
  "on",
  "open",
  "openi",
  "or",
  "overlap",
  "parameter",
  "pause",
  "pi",
  "random",
  "relax",
  "relaxi",
  "reset",
  "return",
  "righty",
  "rx",
  "ry",
  "rz",
  "scale",
  "set",
  "shift",
  "sig",
  "signal",
  "single",
  "speed",
  "step",
  "stop",
  "then",
  "timer",
  "to",
  "tool",
  "trans",
  "true",
  "type",
  "until",
  "value",
  "wait",
  "while",
  "xor",
]);

/**
 * A name of V+: a letter first, then letters, digits and `_`, lower case, at most 15 characters, and not in `taken`.
 */
export function vPlusName(name: string, taken: ReadonlySet<string> = new Set()): string {
  const plain = asciiText(name)
    .toLowerCase()
    .replace(/[^a-z0-9_]+/g, "_")
    .replace(/^_+|_+$/g, "");
  const letterFirst = /^[a-z]/.test(plain) ? plain : `n_${plain}`.replace(/_$/, "");
  const stem = letterFirst.slice(0, LENGTH).replace(/_+$/, "");
  for (let i = 1; ; i++) {
    const tail = i === 1 ? (RESERVED.has(stem) ? "_" : "") : `_${i}`;
    const tried = stem.slice(0, LENGTH - tail.length) + tail;
    if (!taken.has(tried)) return tried;
  }
}

/**
 * What a person called something, as it can stand in a comment. Marks that the reader of comments keeps for itself are
 * dropped.
 */
export const commentText = (name: string): string => asciiText(name).replace(/^[*=;\-\s]+/, "");
