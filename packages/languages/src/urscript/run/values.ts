import type { TextPlace } from "@twincell/core";
import { TextError, compared, computed, finite } from "../../parser/index.ts";
import type { Six } from "./frame.ts";

/** A pose, and where it was made of a variable and a pose in it: the frame that a person meant. */
export interface PoseValue {
  readonly kind: "pose";
  readonly six: Six;
  readonly inFrame?: { readonly frame: string; readonly of: Six; readonly six: Six };
}
/** A list of fixed length. Joint angles that were solved for a pose remember it. */
export interface ListValue {
  readonly kind: "list";
  readonly items: Value[];
  readonly solves?: Solves;
}
/** A pose whose joint angles are asked for, and the posture it is reached from. */
export interface Solves {
  readonly pose: PoseValue;
  readonly near: readonly number[];
}
export type Value = number | boolean | string | PoseValue | ListValue;

export const kindOf = (value: Value): string =>
  typeof value === "number"
    ? "a number"
    : typeof value === "boolean"
      ? "True or False"
      : typeof value === "string"
        ? "a text"
        : value.kind === "pose"
          ? "a pose"
          : "a list";

export function asNumber(value: Value, at: TextPlace): number {
  if (typeof value === "number") return value;
  throw new TextError(at, "a number", `${sentence(kindOf(value))} stands where a number is expected.`);
}

export function asTruth(value: Value, at: TextPlace): boolean {
  if (typeof value === "boolean") return value;
  throw new TextError(at, "True or False", `${sentence(kindOf(value))} stands where True or False is expected.`);
}

export function asPose(value: Value, at: TextPlace): PoseValue {
  if (typeof value === "object" && value.kind === "pose") return value;
  throw new TextError(at, "a pose p[…]", `${sentence(kindOf(value))} stands where a pose is expected.`);
}

export function asNumbers(value: Value, count: number, at: TextPlace): readonly number[] {
  if (typeof value === "object" && value.kind === "list" && value.items.length === count)
    return value.items.map(item => asNumber(item, at));
  throw new TextError(
    at,
    `a list of ${count} numbers`,
    `${sentence(typeof value === "object" && value.kind === "list" ? `a list of ${value.items.length}` : kindOf(value))} stands where ${count} numbers are expected.`,
  );
}

const sentence = (words: string): string => words.charAt(0).toUpperCase() + words.slice(1);

export function poseOf(numbers: readonly number[], at: TextPlace): PoseValue {
  const [x, y, z, rx, ry, rz] = numbers;
  if (
    numbers.length !== 6 ||
    x === undefined ||
    y === undefined ||
    z === undefined ||
    rx === undefined ||
    ry === undefined ||
    rz === undefined
  ) {
    throw new TextError(at, "p[x, y, z, rx, ry, rz]", `A pose has 6 numbers; here are ${numbers.length}.`);
  }
  return { kind: "pose", six: [x, y, z, rx, ry, rz] };
}

export function binary(sign: string, left: Value, right: Value, at: TextPlace): Value {
  if (sign === "==" || sign === "!=") return same(left, right, at) === (sign === "==");
  if (sign === "+" && typeof left === "string" && typeof right === "string") return left + right;
  if (typeof left === "boolean" || typeof right === "boolean" || sign === "and" || sign === "or" || sign === "xor") {
    const a = asTruth(left, at);
    const b = asTruth(right, at);
    if (sign === "and") return a && b;
    if (sign === "or") return a || b;
    if (sign === "xor") return a !== b;
    throw new TextError(at, "two numbers", `"${sign}" does not join truth values.`);
  }
  const a = asNumber(left, at);
  const b = asNumber(right, at);
  const value = compared(sign, a, b) ?? computed(sign, a, b, at);
  if (value === undefined) throw new TextError(at, "an operator", `"${sign}" is no operator.`);
  return typeof value === "boolean" ? value : finite(value, at);
}

function same(a: Value, b: Value, at: TextPlace): boolean {
  if (typeof a !== "object" || typeof b !== "object") {
    if (typeof a !== typeof b)
      throw new TextError(at, "two values of one sort", `${sentence(kindOf(a))} is compared with ${kindOf(b)}.`);
    return a === b;
  }
  if (a.kind === "pose" && b.kind === "pose") return a.six.every((value, i) => value === b.six[i]);
  if (a.kind === "list" && b.kind === "list")
    return a.items.length === b.items.length && a.items.every((item, i) => same(item, b.items[i]!, at));
  return false;
}
