import type { TextPlace } from "@twincell/core";
import { NotGiven, TextError } from "../faults.ts";
import type { Rigid, Six } from "./rigid.ts";

/** What a controller says of the posture at a place; what it leaves open is undefined. */
export interface Posture {
  /** The wrist is in front of axis 1. */
  readonly front?: boolean;
  /** The elbow is above the line from shoulder to wrist. */
  readonly up?: boolean;
  /** The forearm is bent forwards from the upper arm. */
  readonly bent?: boolean;
  /** Axis 5 is turned in its positive sense, as the controller counts. */
  readonly wrist?: boolean;
}
/**
 * A place, the frame that its numbers count in ("" for the base of the robot), and where it was made of a variable and
 * a place in it.
 */
export interface PlaceValue {
  readonly kind: "place";
  readonly at: Rigid;
  readonly frame: string;
  readonly posture?: Posture;
  readonly within?: { readonly variable: string; readonly of: Rigid; readonly at: Rigid };
}
/** Joint angles [°]. */
export interface JointsValue {
  readonly kind: "joints";
  readonly deg: readonly number[];
}
/** A step from a place: along the axes that it is given in, or along its own. */
export interface ShiftValue {
  readonly kind: "shift";
  readonly by: Six;
  readonly isOwn: boolean;
}
/** What only the controller knows: a variable or a point that no file gives a value. */
export interface UnknownValue {
  readonly kind: "unknown";
  readonly name: string;
}
/** Truth is a number: 0 is false. */
export type Value = number | string | PlaceValue | JointsValue | ShiftValue | UnknownValue;
export const isUnknown = (value: Value): value is UnknownValue => typeof value === "object" && value.kind === "unknown";

const SORTS = {
  unknown: "what is in none of the files",
  place: "a place",
  joints: "a set of joint angles",
  shift: "a step from a place",
} as const;
export const sortOf = (value: Value): string =>
  typeof value === "number" ? "a number" : typeof value === "string" ? "a text" : SORTS[value.kind];

const instead = (value: Value, wanted: string, at: TextPlace): TextError =>
  new TextError(
    at,
    wanted,
    `${sortOf(value).replace(/^./, letter => letter.toUpperCase())} stands where ${wanted} is expected.`,
  );

export function numberIn(value: Value, at: TextPlace): number {
  if (typeof value !== "number") throw instead(value, "a number", at);
  return value;
}

export function placeIn(value: Value, at: TextPlace): PlaceValue {
  if (isUnknown(value)) throw new NotGiven(at, "a place", `${value.name} is in none of the files`);
  if (typeof value !== "object" || value.kind !== "place") throw instead(value, "a place", at);
  return value;
}

/** A number between these, or a fault at its place. */
export function between(value: number, least: number, most: number, what: string, at: TextPlace): number {
  if (value >= least && value <= most) return value;
  throw new TextError(
    at,
    `${what} from ${least} to ${most}`,
    `${what.replace(/^./, letter => letter.toUpperCase())} is ${value}.`,
  );
}

/** Signs between two numbers, or two texts. */
export function arithmetic(
  sign: string,
  left: Value,
  right: Value,
  truth: (is: boolean) => number,
  at: TextPlace,
): Value {
  if (typeof left === "string" && typeof right === "string") {
    if (sign === "+") return left + right;
    if (sign === "=" || sign === "<>") return truth((left === right) === (sign === "="));
    throw new TextError(at, "+, = or <>", `"${sign}" does not join two texts.`);
  }
  const a = numberIn(left, at);
  const b = numberIn(right, at);
  if ((sign === "/" || sign === "mod") && b === 0)
    throw new TextError(at, "a divisor other than 0", "The divisor is 0.");
  const value = NUMBERS[sign]?.(a, b);
  if (value === undefined) throw new TextError(at, "an operator", `"${sign}" is no operator.`);
  if (typeof value === "boolean") return truth(value);
  if (!Number.isFinite(value)) throw new TextError(at, "a finite result", "The result is not a number.");
  return value;
}
const NUMBERS: Readonly<Record<string, (a: number, b: number) => number | boolean>> = {
  "+": (a, b) => a + b,
  "-": (a, b) => a - b,
  "*": (a, b) => a * b,
  "/": (a, b) => a / b,
  "^": (a, b) => a ** b,
  "**": (a, b) => a ** b,
  mod: (a, b) => a % b,
  "=": (a, b) => a === b,
  "==": (a, b) => a === b,
  "<>": (a, b) => a !== b,
  "><": (a, b) => a !== b,
  "<": (a, b) => a < b,
  ">": (a, b) => a > b,
  "<=": (a, b) => a <= b,
  ">=": (a, b) => a >= b,
  and: (a, b) => a !== 0 && b !== 0,
  or: (a, b) => a !== 0 || b !== 0,
  xor: (a, b) => (a !== 0) !== (b !== 0),
};
