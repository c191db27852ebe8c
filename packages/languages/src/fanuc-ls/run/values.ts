import type { TextPlace } from "@twincell/core";
import { TextError, compared, computed, finite } from "../../parser/index.ts";

/** Joint angles [deg] as the pendant shows them. */
export interface JointValue {
  readonly joints_deg: readonly number[];
}
/** A number, ON or OFF, the six numbers of a position, or its joint angles. NaN is what only the controller knows. */
export type Value = number | boolean | readonly number[] | JointValue;

export const isSix = (value: Value): value is readonly number[] => Array.isArray(value);
export const isJoints = (value: Value): value is JointValue => typeof value === "object" && !Array.isArray(value);
/** A position that only the controller knows. */
export const UNKNOWN: readonly number[] = [NaN, NaN, NaN, NaN, NaN, NaN];
export const isKnown = (six: readonly number[]): boolean => !six.some(Number.isNaN);

export function asNumber(value: Value, at: TextPlace): number {
  if (typeof value === "number") return value;
  throw new TextError(
    at,
    "a number",
    `${typeof value === "object" ? "A position" : "ON or OFF"} stands where a number is expected.`,
  );
}

export function binary(sign: string, left: Value, right: Value, at: TextPlace): Value {
  if (typeof left === "boolean" && typeof right === "boolean") return logic(sign, left, right, at);
  if (typeof left === "boolean" || typeof right === "boolean") {
    // ON is 1 beside a number.
    if (typeof left === "number" || typeof right === "number")
      return binary(sign, Number(left as number | boolean), Number(right as number | boolean), at);
  }
  // Positions add and subtract number by number.
  if (isSix(left) && isSix(right) && (sign === "+" || sign === "-"))
    return left.map((value, i) => (sign === "+" ? value + right[i]! : value - right[i]!));
  const a = asNumber(left, at);
  const b = asNumber(right, at);
  const value = compared(sign, a, b) ?? computed(sign, a, b, at);
  if (value === undefined) throw new TextError(at, "an operator", `"${sign}" does not join numbers.`);
  return typeof value === "boolean" || sign === "div" || sign === "mod"
    ? value
    : finite(value, at, "The result is no number.");
}

function logic(sign: string, left: boolean, right: boolean, at: TextPlace): boolean {
  switch (sign) {
    case "and":
      return left && right;
    case "or":
      return left || right;
    case "=":
      return left === right;
    case "<>":
      return left !== right;
    default:
      throw new TextError(at, "AND, OR, = or <>", `"${sign}" does not join ON and OFF.`);
  }
}
