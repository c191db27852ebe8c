import { degrees } from "../../spatial/units.ts";
import type { Expression, Unit } from "./expression.ts";
import { KEYWORDS, WRITTEN_UNITS } from "./words.ts";

/** How strongly an expression holds together; what is weaker stands in brackets. */
const STRENGTH = {
  or: 1,
  and: 2,
  not: 3,
  "=": 4,
  "<>": 4,
  "<": 4,
  "<=": 4,
  ">": 4,
  ">=": 4,
  "+": 5,
  "-": 5,
  "*": 6,
  "/": 6,
  div: 6,
  mod: 6,
  neg: 7,
} as const;

/**
 * An expression in one line, as a person types it: `count + 1 < 9 and not in_3`. `parseExpression` reads it back to the
 * very same tree.
 */
export const printExpression = (expression: Expression): string => printed(expression, 0);

function printed(expression: Expression, around: number): string {
  if (typeof expression === "boolean") return String(expression);
  if (typeof expression === "number") return bracketed(String(expression), around, expression < 0 ? STRENGTH.neg : 8);
  if ("value" in expression)
    return bracketed(quantity(expression.value, expression.unit), around, expression.value < 0 ? STRENGTH.neg : 8);
  if ("variable" in expression) return expression.variable;
  if ("signal" in expression) return nameInText(expression.signal);
  if ("call" in expression) return `${expression.call}(${expression.of.map(part => printed(part, 0)).join(", ")})`;
  const strength = STRENGTH[expression.op];
  const [a] = expression.of;
  if (expression.op === "not") return bracketed(`not ${printed(a, strength)}`, around, strength);
  // A number behind a sign would be read as one number: -(3) is not -3.
  if (expression.op === "neg") {
    const isNumber = typeof a === "number" || (typeof a === "object" && "value" in a);
    return bracketed(isNumber ? `-(${printed(a, 0)})` : `-${printed(a, strength + 1)}`, around, strength);
  }
  const b = expression.of[1]!;
  // Comparisons stand beside nothing of their own strength; the others are read from the left.
  const left = strength === 4 ? strength + 1 : strength;
  return bracketed(`${printed(a, left)} ${expression.op} ${printed(b, strength + 1)}`, around, strength);
}

const bracketed = (text: string, around: number, strength: number): string => (strength < around ? `(${text})` : text);

/** A name as it stands in an expression: in quotes unless it is one word that means nothing else. */
export const nameInText = (name: string): string =>
  /^[\p{L}_][\p{L}\p{N}_]*$/u.test(name) && !KEYWORDS.has(name.toLowerCase())
    ? name
    : `"${name.replaceAll(/["\\]/g, "\\$&")}"`;

/** A quantity in the unit people use, as long as it reads back to the very same number. */
function quantity(value: number, unit: Unit): string {
  const everyday = { m: "mm", rad: "deg", s: "s", kg: "kg", "m/s": "mm/s", "rad/s": "deg/s" }[unit];
  const shown = everyday === unit ? value : unit.startsWith("rad") ? degrees(value) : value * 1000;
  for (const digits of [6, 9, 12, 15]) {
    const short = Number(shown.toPrecision(digits));
    if (WRITTEN_UNITS[everyday]!.into(short) === value) return `${short} ${everyday}`;
  }
  return `${value} ${unit}`;
}
