import { Refusal } from "../../refusal.ts";
import type { Budget } from "../budget.ts";
import { formatPercent } from "./format.ts";
import { integerOf, isTrue, kindOf, List, numberOf, sentenceCase, type Value } from "./values.ts";

/** Whole numbers stay below 2 to this power. */
const LARGEST_BITS = 4096;

/** `not a`, `-a`, `+a`, `~a`. */
export function unary(operator: string, a: Value): Value {
  if (operator === "not") return !isTrue(a);
  const whole = integerOf(a);
  const number = numberOf(a);
  if (operator === "~" && whole !== undefined) return ~whole;
  if (number === undefined || operator === "~") throw new Refusal(`“${operator}” cannot be applied to ${kindOf(a)}.`);
  if (whole !== undefined) return operator === "-" ? -whole : whole;
  return operator === "-" ? -number : number;
}

/** `a + b` and the other operators between two values. @throws {Refusal} when they do not go together, or 0 divides. */
export function binary(operator: string, a: Value, b: Value, budget: Budget): Value {
  if (operator === "+" && typeof a === "string" && typeof b === "string") {
    budget.spend(a.length + b.length);
    return a + b;
  }
  if (operator === "+" && a instanceof List && b instanceof List && a.isTuple === b.isTuple) {
    budget.spend(a.items.length + b.items.length);
    return new List([...a.items, ...b.items], a.isTuple);
  }
  if (operator === "%" && typeof a === "string")
    return formatPercent(a, b instanceof List && b.isTuple ? b.items : [b], budget);
  if (operator === "*") {
    const repeated = repeat(a, b, budget) ?? repeat(b, a, budget);
    if (repeated !== undefined) return repeated;
  }
  const x = numberOf(a);
  const y = numberOf(b);
  const m = integerOf(a);
  const n = integerOf(b);
  if (x === undefined || y === undefined)
    throw new Refusal(`${sentenceCase(kindOf(a))} and ${kindOf(b)} cannot be combined with “${operator}”.`);
  if (m !== undefined && n !== undefined && operator !== "/") {
    const result = whole(operator, m, n);
    if (result !== undefined) return result;
  }
  return real(operator, x, y);
}

function repeat(what: Value, times: Value, budget: Budget): Value | undefined {
  const count = integerOf(times);
  if (count === undefined || !(typeof what === "string" || what instanceof List)) return undefined;
  const often = count > 0n ? Number(count) : 0;
  const size = typeof what === "string" ? what.length : what.items.length;
  budget.spend(often * size);
  return typeof what === "string"
    ? what.repeat(size === 0 ? 0 : often)
    : new List(size === 0 ? [] : Array.from({ length: often * size }, (_, i) => what.items[i % size]!), what.isTuple);
}

/**
 * Whole numbers; undefined where the answer is not whole. Division rounds down, the remainder has the divisor's sign.
 */
function whole(operator: string, a: bigint, b: bigint): bigint | undefined {
  switch (operator) {
    case "+":
      return a + b;
    case "-":
      return a - b;
    case "*":
      return within(a * b);
    case "&":
      return a & b;
    case "|":
      return a | b;
    case "^":
      return a ^ b;
    case "<<":
    case ">>": {
      if (b < 0n || (operator === "<<" && b > LARGEST_BITS)) throw new Refusal(`A number is shifted by ${b} places.`);
      return operator === "<<" ? within(a << b) : a >> b;
    }
    case "//":
    case "%": {
      if (b === 0n) throw new Refusal(`“${operator}” divides by 0.`);
      const rest = a % b;
      const modulo = rest !== 0n && rest < 0n !== b < 0n ? rest + b : rest;
      return operator === "%" ? modulo : (a - modulo) / b;
    }
    case "**": {
      if (b < 0n) return undefined;
      if (b * BigInt(a.toString(2).length) > LARGEST_BITS * 2 && a !== 0n && a !== 1n && a !== -1n)
        throw new Refusal(`${a} to the power of ${b} is too large.`);
      return within(a ** b);
    }
    default:
      return undefined;
  }
}

function within(value: bigint): bigint {
  if (value > 1n << BigInt(LARGEST_BITS) || value < -(1n << BigInt(LARGEST_BITS)))
    throw new Refusal("A whole number has more than 1233 digits.");
  return value;
}

function real(operator: string, a: number, b: number): number {
  switch (operator) {
    case "+":
      return a + b;
    case "-":
      return a - b;
    case "*":
      return a * b;
    case "/":
    case "//":
    case "%": {
      if (b === 0) throw new Refusal(`“${operator}” divides by 0.`);
      const rest = a % b;
      const modulo = rest !== 0 && rest < 0 !== b < 0 ? rest + b : rest;
      return operator === "/" ? a / b : operator === "%" ? modulo : Math.round((a - modulo) / b);
    }
    case "**": {
      if (a === 0 && b < 0) throw new Refusal("0 has no negative power.");
      const power = a ** b;
      if (Number.isNaN(power) && !Number.isNaN(a) && !Number.isNaN(b))
        throw new Refusal(`${a} has no real power ${b}.`);
      return power;
    }
    default:
      throw new Refusal(`“${operator}” works on whole numbers only.`);
  }
}
