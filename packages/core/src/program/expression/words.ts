import { radians } from "../../spatial/units.ts";
import { FUNCTION_NAMES, type Unit } from "./expression.ts";

/** Units as they are written behind a number, and what they become. */
export const WRITTEN_UNITS: Readonly<
  Record<string, { readonly unit: Unit; readonly into: (value: number) => number }>
> = {
  m: { unit: "m", into: value => value },
  mm: { unit: "m", into: value => value / 1000 },
  rad: { unit: "rad", into: value => value },
  deg: { unit: "rad", into: radians },
  "°": { unit: "rad", into: radians },
  s: { unit: "s", into: value => value },
  ms: { unit: "s", into: value => value / 1000 },
  kg: { unit: "kg", into: value => value },
  "m/s": { unit: "m/s", into: value => value },
  "mm/s": { unit: "m/s", into: value => value / 1000 },
  "rad/s": { unit: "rad/s", into: value => value },
  "deg/s": { unit: "rad/s", into: radians },
};

/** Words that mean something by themselves: no variable has one of them as its name. */
export const KEYWORDS: ReadonlySet<string> = new Set([
  "and",
  "or",
  "not",
  "div",
  "mod",
  "true",
  "false",
  ...FUNCTION_NAMES,
]);
