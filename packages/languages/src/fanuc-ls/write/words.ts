import { asciiText } from "../../parser/index.ts";

/** Words that a program must not be called. */
export const RESERVED: ReadonlySet<string> = new Set([
  "con",
  "prn",
  "nul",
  "aux",
  "j",
  "l",
  "c",
  "a",
  "s",
  "p",
  "pr",
  "r",
  "ar",
  "sr",
  "di",
  "do",
  "ai",
  "ao",
  "gi",
  "go",
  "ri",
  "ro",
  "ui",
  "uo",
  "si",
  "so",
  "lbl",
  "jmp",
  "call",
  "run",
  "end",
  "if",
  "then",
  "else",
  "endif",
  "for",
  "to",
  "downto",
  "endfor",
  "select",
  "wait",
  "pause",
  "abort",
  "message",
  "timer",
  "on",
  "off",
]);

/** A line or register with what a person calls it. */
export function labelled(word: string, number: number, name: string): string {
  const label = asciiText(name)
    .replace(/[[\]:;]/g, " ")
    .slice(0, 16)
    .trim();
  return label === "" || /^[A-Z]+ [0-9]*$/.test(label) || name === `${word}[${number}]`
    ? `${word}[${number}]`
    : `${word}[${number}:${label}]`;
}
