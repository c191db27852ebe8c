import type { TextPlace } from "@twincell/core";
import { NotGiven, TextError, inverted, times, type Matrix, compared, computed, finite } from "../../parser/index.ts";

/** A place, and where it was made of a variable and a place in it: the frame that a person meant. */
export interface PlaceValue {
  readonly kind: "place";
  readonly at: Matrix;
  readonly inFrame?: { readonly frame: string; readonly of: Matrix; readonly at: Matrix };
}
/** Joint angles [°]. */
export interface JointsValue {
  readonly kind: "joints";
  readonly deg: readonly number[];
}
/** What only the controller knows: a variable that no file gives a value. */
export interface UnknownValue {
  readonly kind: "unknown";
  readonly name: string;
}
/** All values of a row, by their indices: handed to a program. */
export interface RowValue {
  readonly kind: "row";
  readonly values: ReadonlyMap<string, Value>;
}
/** Truth is a number: TRUE is -1, FALSE is 0. */
export type Value = number | string | PlaceValue | JointsValue | UnknownValue | RowValue;
export const isUnknown = (value: Value | undefined): value is UnknownValue =>
  typeof value === "object" && value.kind === "unknown";

const KINDS = {
  place: "a transformation",
  joints: "a set of joint angles",
  unknown: "what is in none of the files",
  row: "a row of values",
} as const;

export const kindOf = (value: Value): string =>
  typeof value === "number" ? "a number" : typeof value === "string" ? "a text" : KINDS[value.kind];
const stands = (value: Value, wanted: string): string => {
  const what = kindOf(value);
  return `${what.charAt(0).toUpperCase()}${what.slice(1)} stands where ${wanted} is expected.`;
};

export function asNumber(value: Value, at: TextPlace): number {
  if (typeof value === "number") return value;
  throw new TextError(at, "a number", stands(value, "a number"));
}

export function asPlace(value: Value, at: TextPlace): PlaceValue {
  if (typeof value === "object" && value.kind === "place") return value;
  if (isUnknown(value)) throw new NotGiven(at, "a transformation", `${value.name} is in none of the files`);
  throw new TextError(at, "a transformation", stands(value, "a transformation"));
}

export const truth = (value: boolean): number => (value ? -1 : 0);

/** `+` of transformations goes on from the left one; `-` goes back by the right one. */
export function binary(sign: string, left: Value, right: Value, frame: string | undefined, at: TextPlace): Value {
  if (typeof left === "object" && left.kind === "place" && (sign === "+" || sign === "-")) {
    const on = asPlace(right, at);
    const step = sign === "+" ? on.at : inverted(on.at);
    const place = times(left.at, step);
    if (left.inFrame !== undefined && frame === undefined)
      return { kind: "place", at: place, inFrame: { ...left.inFrame, at: times(left.inFrame.at, step) } };
    return frame === undefined
      ? { kind: "place", at: place }
      : { kind: "place", at: place, inFrame: { frame, of: left.at, at: step } };
  }
  if (typeof left === "string" || typeof right === "string") {
    if (typeof left === "string" && typeof right === "string") {
      if (sign === "+") return left + right;
      if (sign === "==" || sign === "<>") return truth((left === right) === (sign === "=="));
    }
    throw new TextError(
      at,
      "two texts with +, == or <>",
      `"${sign}" does not join ${kindOf(left)} and ${kindOf(right)}.`,
    );
  }
  return arithmetic(sign, asNumber(left, at), asNumber(right, at), at);
}

function arithmetic(sign: string, a: number, b: number, at: TextPlace): number {
  switch (sign) {
    case "and":
      return truth(a !== 0 && b !== 0);
    case "or":
      return truth(a !== 0 || b !== 0);
    case "xor":
      return truth((a !== 0) !== (b !== 0));
  }
  const value = compared(sign, a, b) ?? computed(sign, a, b, at);
  if (value === undefined) throw new TextError(at, "an operator", `"${sign}" is no operator.`);
  if (typeof value === "boolean") return truth(value);
  return sign === "mod" ? value : finite(value, at);
}
