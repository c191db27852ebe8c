/**
 * Values as the variables of a KUKA controller are written as text: numbers plain, BOOL `TRUE`, enumerations `#EX`,
 * texts in quotes, structures `{E6AXIS: A1 0.0, A2 -90.0}` with their type in front or without it. Names count in any
 * case.
 */
export type KrlValue =
  | { readonly kind: "number"; readonly value: number }
  | { readonly kind: "bool"; readonly value: boolean }
  | { readonly kind: "enum"; readonly name: string }
  | { readonly kind: "text"; readonly value: string }
  | { readonly kind: "struct"; readonly type: string; readonly parts: ReadonlyMap<string, KrlValue> };
export type KrlRead =
  | { readonly kind: "value"; readonly value: KrlValue }
  | { readonly kind: "not-understood"; readonly column: number; readonly expected: string };

const DEEPEST = 8;
const NUMBER = /[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?/y;
const NAME = /[A-Za-z_$][A-Za-z0-9_$]*(?:\[[0-9]*\])?/y;
const RADIX = /'([BbHh])([0-9A-Fa-f]+)'/y;
const BLANK = /[ \t]*/y;
const QUOTED = /"([^"]*)"/y;

/** Reads one value and nothing behind it. Never throws; nesting is bounded. */
export function readKrlValue(text: string): KrlRead {
  let at = 0;
  const match = (pattern: RegExp): RegExpExecArray | null => {
    pattern.lastIndex = at;
    const found = pattern.exec(text);
    if (found) at = pattern.lastIndex;
    return found;
  };
  const skip = (): void => {
    match(BLANK);
  };
  const fail = (expected: string): KrlRead => ({ kind: "not-understood", column: at + 1, expected });
  const taken = (sign: string): boolean => {
    skip();
    if (text[at] !== sign) return false;
    at++;
    return true;
  };

  function value(depth: number): KrlRead {
    skip();
    if (text[at] === "{")
      return depth >= DEEPEST ? fail(`at most ${DEEPEST} structures inside each other`) : struct(depth);
    const number = match(NUMBER);
    if (number) return finite(Number(number[0]));
    const radix = match(RADIX);
    if (radix) return finite(Number.parseInt(radix[2]!, radix[1]!.toUpperCase() === "B" ? 2 : 16));
    const quoted = match(QUOTED);
    if (quoted) return { kind: "value", value: { kind: "text", value: quoted[1]! } };
    if (text[at] === "#") {
      at++;
      const name = match(NAME);
      return name ? { kind: "value", value: { kind: "enum", name: name[0].toUpperCase() } } : fail("a name after #");
    }
    const before = at;
    const word = match(NAME)?.[0].toUpperCase();
    if (word === "TRUE" || word === "FALSE") return { kind: "value", value: { kind: "bool", value: word === "TRUE" } };
    at = before;
    return fail("a value");
  }
  const finite = (number: number): KrlRead =>
    Number.isFinite(number)
      ? { kind: "value", value: { kind: "number", value: number } }
      : fail("a number that can be held");

  function struct(depth: number): KrlRead {
    at++;
    const parts = new Map<string, KrlValue>();
    skip();
    let name = match(NAME)?.[0].toUpperCase();
    let type = "";
    if (name !== undefined && taken(":")) {
      type = name;
      skip();
      name = match(NAME)?.[0].toUpperCase();
    }
    for (;;) {
      if (name === undefined) return fail("the name of a part");
      const read = value(depth + 1);
      if (read.kind === "not-understood") return read;
      parts.set(name, read.value);
      if (taken("}")) return { kind: "value", value: { kind: "struct", type, parts } };
      if (!taken(",")) return fail("a comma or a closing brace");
      skip();
      name = match(NAME)?.[0].toUpperCase();
    }
  }

  const read = value(0);
  if (read.kind === "not-understood") return read;
  skip();
  return at === text.length ? read : fail("the end");
}

/** REAL of the controller is 32 bits wide: about seven digits. */
export const REAL_DIGITS = 7;
/** A REAL as text: always with a point, in the digits that a 32-bit number holds unless more are asked for. */
export function krlReal(value: number, digits = REAL_DIGITS): string {
  const text = String(
    Number((digits <= REAL_DIGITS ? Math.fround(value) : value).toPrecision(digits)) + 0,
  ).toUpperCase();
  return /[.E]/.test(text) ? text : `${text}.0`;
}
export const krlBool = (value: boolean): string => (value ? "TRUE" : "FALSE");
export const krlText = (value: string): string => `"${value.replaceAll('"', "'")}"`;
/** `{TYPE: NAME 1.0, …}` of numbers; integers stay without a point where `whole` names them. */
export const krlStruct = (
  type: string,
  parts: readonly (readonly [string, number])[],
  digits = REAL_DIGITS,
  whole: readonly string[] = [],
): string =>
  `{${type}: ${parts.map(([name, value]) => `${name} ${whole.includes(name) ? String(Math.round(value)) : krlReal(value, digits)}`).join(", ")}}`;

/** The number in a text, NaN when it holds none. */
export function numberIn(text: string): number {
  const read = readKrlValue(text);
  return read.kind === "value" && read.value.kind === "number" ? read.value.value : NaN;
}
/** Undefined when it is no BOOL. */
export function boolIn(text: string): boolean | undefined {
  const read = readKrlValue(text);
  return read.kind === "value" && read.value.kind === "bool" ? read.value.value : undefined;
}
/** The name of an enumeration value without its #, or "". */
export function enumIn(text: string): string {
  const read = readKrlValue(text);
  return read.kind === "value" && read.value.kind === "enum" ? read.value.name : "";
}
/** What stands between quotes; a text without them as it stands. */
export function textIn(text: string): string {
  const read = readKrlValue(text);
  return read.kind === "value" && read.value.kind === "text" ? read.value.value : text;
}
/** The named numbers of a structure into `out`, in that order; false when one is missing or is no number. */
export function partsIn(text: string, names: readonly string[], out: Float64Array): boolean {
  const read = readKrlValue(text);
  if (read.kind !== "value" || read.value.kind !== "struct") return false;
  for (let i = 0; i < names.length; i++) {
    const part = read.value.parts.get(names[i]!);
    if (part?.kind !== "number") return false;
    out[i] = part.value;
  }
  return true;
}
