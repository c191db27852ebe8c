import type { TextPlace } from "@twincell/core";
import { TextError, compared, computed, finite } from "../../parser/index.ts";
import { normal, type Frame } from "./frame.ts";

/** Numbers, truth values, texts, and records or arrays of them. */
export type Value = number | boolean | string | readonly Value[];

const kindOf = (value: Value): string =>
  typeof value === "number"
    ? "a number"
    : typeof value === "boolean"
      ? "TRUE or FALSE"
      : typeof value === "string"
        ? "a text"
        : `a record of ${value.length}`;
const stands = (value: Value, at: TextPlace, expected: string): TextError => {
  const kind = kindOf(value);
  return new TextError(
    at,
    expected,
    `${kind.charAt(0).toUpperCase()}${kind.slice(1)} stands where ${expected} is expected.`,
  );
};

export function asNumber(value: Value, at: TextPlace): number {
  if (typeof value === "number") return value;
  throw stands(value, at, "a number");
}
export function asTruth(value: Value, at: TextPlace): boolean {
  if (typeof value === "boolean") return value;
  throw stands(value, at, "TRUE or FALSE");
}
export function asRecord(value: Value | undefined, at: TextPlace, count: number, what: string): readonly Value[] {
  if (typeof value === "object" && value.length === count) return value;
  throw stands(value ?? "", at, what);
}
export function asNumbers(value: Value | undefined, at: TextPlace, count: number, what: string): readonly number[] {
  return asRecord(value, at, count, what).map(each => asNumber(each, at));
}

/** A pose `[[x,y,z],[q1,q2,q3,q4]]`. */
export function asFrame(value: Value | undefined, at: TextPlace): Frame {
  const [trans, rot] = asRecord(value, at, 2, "a pose [[x,y,z],[q1,q2,q3,q4]]");
  return { mm: asPosition(trans, at), wxyz: asOrient(rot, at) };
}
export function asPosition(value: Value | undefined, at: TextPlace): Frame["mm"] {
  const [x, y, z] = asNumbers(value, at, 3, "a position [x,y,z]");
  return [x!, y!, z!];
}
export function asOrient(value: Value | undefined, at: TextPlace): Frame["wxyz"] {
  const [w, x, y, z] = asNumbers(value, at, 4, "an orientation [q1,q2,q3,q4]");
  const unit = normal([w!, x!, y!, z!]);
  if (unit === undefined)
    throw new TextError(
      at,
      "a quaternion of length 1",
      `The quaternion has the length ${Math.hypot(w!, x!, y!, z!).toPrecision(4)}.`,
    );
  return unit;
}
export const fromFrame = ({ mm, wxyz }: Frame): Value => [[...mm], [...wxyz]];

/** Where a component stands in its record. */
const COMPONENTS: Readonly<Record<string, number>> = {
  trans: 0,
  rot: 1,
  robconf: 2,
  x: 0,
  y: 1,
  z: 2,
  q1: 0,
  q2: 1,
  q3: 2,
  q4: 3,
  cf1: 0,
  cf4: 1,
  cf6: 2,
  cfx: 3,
  robax: 0,
  rax_1: 0,
  rax_2: 1,
  rax_3: 2,
  rax_4: 3,
  rax_5: 4,
  rax_6: 5,
  eax_a: 0,
  eax_b: 1,
  eax_c: 2,
  eax_d: 3,
  eax_e: 4,
  eax_f: 5,
  robhold: 0,
  tframe: 1,
  tload: 2,
  mass: 0,
  cog: 1,
  aom: 2,
  ix: 3,
  iy: 4,
  iz: 5,
  ufprog: 1,
  ufmec: 2,
  uframe: 3,
  oframe: 4,
  v_tcp: 0,
  v_ori: 1,
  v_leax: 2,
  v_reax: 3,
  finep: 0,
  pzone_tcp: 1,
  pzone_ori: 2,
  pzone_eax: 3,
  zone_ori: 4,
  zone_leax: 5,
  zone_reax: 6,
};
/** External axes come last in a robtarget and in a jointtarget. */
export const placeOf = (record: readonly Value[], component: string): number | undefined =>
  component === "extax" ? record.length - 1 : COMPONENTS[component];

export function binary(sign: string, left: Value, right: Value, at: TextPlace): Value {
  if (sign === "=" || sign === "<>") return same(left, right) === (sign === "=");
  if (sign === "and" || sign === "or" || sign === "xor") {
    const a = asTruth(left, at);
    const b = asTruth(right, at);
    return sign === "and" ? a && b : sign === "or" ? a || b : a !== b;
  }
  if (typeof left === "string" && typeof right === "string" && sign === "+") return left + right;
  if (typeof left === "object" || typeof right === "object") return vector(sign, left, right, at);
  const a = asNumber(left, at);
  const b = asNumber(right, at);
  const value = compared(sign, a, b) ?? computed(sign, a, b, at);
  if (value === undefined) throw new TextError(at, "an operator", `"${sign}" is no operator.`);
  return typeof value === "boolean" ? value : finite(value, at);
}

/** Positions add, and are stretched by a number. */
function vector(sign: string, left: Value, right: Value, at: TextPlace): Value {
  if (typeof left === "number" && sign === "*") return asPosition(right, at).map(x => left * x);
  if (typeof right === "number" && (sign === "*" || sign === "/"))
    return asPosition(left, at).map(x => finite(sign === "*" ? x * right : x / right, at));
  const a = asPosition(left, at);
  const b = asPosition(right, at);
  if (sign === "+" || sign === "-") return a.map((x, i) => (sign === "+" ? x + b[i]! : x - b[i]!));
  throw new TextError(at, "numbers", `"${sign}" does not join positions.`);
}

const same = (a: Value, b: Value): boolean =>
  typeof a === "object" && typeof b === "object"
    ? a.length === b.length && a.every((each, i) => same(each, b[i]!))
    : a === b;
