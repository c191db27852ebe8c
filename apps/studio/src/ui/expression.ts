import { fixed } from "../messages/numbers.ts";

/**
 * What a number field is about; decides the unit when none is typed. Inside: metres, radians, seconds, metres a second,
 * kilograms, 1.
 */
export type Quantity = "length" | "angle" | "time" | "speed" | "mass" | "percent" | "plain";
export type Typed =
  | { readonly kind: "value"; readonly value: number }
  | { readonly kind: "not-understood"; readonly at: number };

/** Unit → factor to the inside unit. The first one is what is shown, and meant when none is typed. */
const UNITS: Readonly<Record<Quantity, Readonly<Record<string, number>>>> = {
  length: { mm: 0.001, cm: 0.01, m: 1, in: 0.0254 },
  angle: { "°": Math.PI / 180, deg: Math.PI / 180, rad: 1 },
  time: { s: 1, ms: 0.001, min: 60 },
  speed: { "mm/s": 0.001, "m/s": 1, "m/min": 1 / 60 },
  mass: { kg: 1, g: 0.001, t: 1000 },
  percent: { "%": 0.01 },
  plain: { "": 1 },
};
export const shownUnit = (quantity: Quantity): string => Object.keys(UNITS[quantity])[0]!;
export const shownFactor = (quantity: Quantity): number => Object.values(UNITS[quantity])[0]!;

/**
 * A typed number: `12.5`, `25 mm`, `90/4`, `2*(3+4) cm`. A leading `+`, `*` or `/` and `-=` count from `current`:
 * `+10` is ten more; `-10` is minus ten, `-=10` ten less. A comma is a decimal point.
 *
 *   sum = product {(+|−) product} · product = unary {(*|/) unary} · unary = [−] (number | "(" sum ")") [unit]
 *
 * @returns the value in the inside unit, or how far the text was understood.
 */
export function parseTyped(text: string, quantity: Quantity, current: number): Typed {
  const shown = shownFactor(quantity);
  const source = text.trim().replaceAll(",", ".").replaceAll("−", "-").replaceAll("×", "*").replaceAll("÷", "/");
  const relative = /^(\+=|-=|\*=|\/=|\+|\*|\/)/.exec(source)?.[0] ?? "";
  let at = relative.length;

  const skip = (): void => {
    while (source[at] === " ") at++;
  };
  /** A value and whether a unit was typed: numbers without one take the shown unit, at the end. */
  interface Part {
    value: number;
    hasUnit: boolean;
  }
  const number = (): Part | null => {
    skip();
    if (source[at] === "-") {
      at++;
      const part = number();
      return part && { value: -part.value, hasUnit: part.hasUnit };
    }
    let part: Part;
    if (source[at] === "(") {
      at++;
      const inner = sum();
      skip();
      if (!inner || source[at] !== ")") return null;
      at++;
      part = inner;
    } else {
      const digits = /^(\d+\.?\d*|\.\d+)(e[+-]?\d+)?/i.exec(source.slice(at))?.[0];
      if (digits === undefined) return null;
      at += digits.length;
      part = { value: Number(digits), hasUnit: false };
    }
    skip();
    const unit = Object.keys(UNITS[quantity])
      .sort((a, b) => b.length - a.length)
      .find(name => name !== "" && source.startsWith(name, at));
    if (unit === undefined) return part;
    at += unit.length;
    return part.hasUnit ? null : { value: part.value * UNITS[quantity][unit]!, hasUnit: true };
  };
  const product = (): Part | null => {
    let left = number();
    for (skip(); left && (source[at] === "*" || source[at] === "/"); skip()) {
      const divide = source[at++] === "/";
      const right = number();
      if (!right || (right.hasUnit && (left.hasUnit || divide))) return null;
      left = {
        value: divide ? left.value / right.value : left.value * right.value,
        hasUnit: left.hasUnit || right.hasUnit,
      };
    }
    return left;
  };
  const inside = (part: Part): Part => (part.hasUnit ? part : { value: part.value * shown, hasUnit: true });
  function sum(): Part | null {
    let left = product();
    for (skip(); left && (source[at] === "+" || source[at] === "-"); skip()) {
      const less = source[at++] === "-";
      const right = product();
      if (!right) return null;
      const mixed = left.hasUnit !== right.hasUnit;
      const a: Part = mixed ? inside(left) : left;
      const b = mixed ? inside(right) : right;
      left = { value: less ? a.value - b.value : a.value + b.value, hasUnit: a.hasUnit };
    }
    return left;
  }

  const part = sum();
  skip();
  if (!part || at !== source.length) return { kind: "not-understood", at };
  const scaled = relative.startsWith("*") || relative.startsWith("/");
  if (scaled && part.hasUnit) return { kind: "not-understood", at };
  const amount = scaled ? part.value : inside(part).value;
  const value = relative.startsWith("+")
    ? current + amount
    : relative.startsWith("-")
      ? current - amount
      : relative.startsWith("*")
        ? current * amount
        : relative.startsWith("/")
          ? current / amount
          : amount;
  return Number.isFinite(value) ? { kind: "value", value } : { kind: "not-understood", at };
}

/** As many decimals as the quantity deserves, with the language's decimal sign, a true minus and never "−0". */
export function showNumber(
  value: number,
  quantity: Quantity,
  decimals = quantity === "time" ? 2 : quantity === "percent" ? 0 : 2,
): string {
  const text = fixed(value / shownFactor(quantity), decimals);
  return (/[1-9]/.test(text) ? text : text.replace("-", "")).replace("-", "−");
}
