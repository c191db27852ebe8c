import type { TextPlace } from "@twincell/core";
import { TextError } from "./faults.ts";

type Of<Result> = Readonly<Record<string, (a: number, b: number) => Result>>;

/** Signs that compare two numbers, of all languages. */
const COMPARING: Of<boolean> = {
  "=": (a, b) => a === b,
  "==": (a, b) => a === b,
  "<>": (a, b) => a !== b,
  "!=": (a, b) => a !== b,
  "<": (a, b) => a < b,
  ">": (a, b) => a > b,
  "<=": (a, b) => a <= b,
  "=<": (a, b) => a <= b,
  ">=": (a, b) => a >= b,
  "=>": (a, b) => a >= b,
};
/** Signs that compute a number of two. */
const COMPUTING: Of<number> = {
  "+": (a, b) => a + b,
  "-": (a, b) => a - b,
  "*": (a, b) => a * b,
  "/": (a, b) => a / b,
  div: (a, b) => Math.trunc(a / b),
  mod: (a, b) => a % b,
  "%": (a, b) => a % b,
  "^": (a, b) => a ** b,
  "**": (a, b) => a ** b,
};
const DIVIDING = new Set(["/", "div", "mod", "%"]);

/** What a comparison answers; undefined for a sign that compares nothing. Which signs there are the grammar says. */
export const compared = (sign: string, a: number, b: number): boolean | undefined =>
  Object.hasOwn(COMPARING, sign) ? COMPARING[sign]!(a, b) : undefined;

/**
 * What two numbers amount to; undefined for a sign that does not compute.
 *
 * @throws {TextError} at `at` where the divisor is 0.
 */
export function computed(sign: string, a: number, b: number, at: TextPlace): number | undefined {
  if (!Object.hasOwn(COMPUTING, sign)) return undefined;
  if (DIVIDING.has(sign) && b === 0) throw new TextError(at, "a divisor other than 0", "The divisor is 0.");
  return COMPUTING[sign]!(a, b);
}

/** @throws {TextError} for what is no number, or without end. */
export function finite(value: number, at: TextPlace, sentence = "The result is not a number."): number {
  if (!Number.isFinite(value)) throw new TextError(at, "a finite result", sentence);
  return value;
}
