import { Refusal } from "../../refusal.ts";
import { shorten } from "../../xml.ts";

/**
 * A value of the expressions in a xacro. Whole numbers are bigint and others number, so that `4/2` is 2.0 and `4//2` is
 * 2 as their writers expect.
 */
export type Value = null | boolean | bigint | number | string | List | Dict | Callable | Names;
export class List {
  readonly items: readonly Value[];
  readonly isTuple: boolean;
  constructor(items: readonly Value[], isTuple = false) {
    this.items = items;
    this.isTuple = isTuple;
  }
}
export class Dict {
  readonly entries: ReadonlyMap<string | bigint | number | boolean | null, Value>;
  constructor(entries: ReadonlyMap<string | bigint | number | boolean | null, Value>) {
    this.entries = entries;
  }
}
export interface Arguments {
  readonly values: readonly Value[];
  readonly named: ReadonlyMap<string, Value>;
}
export class Callable {
  readonly name: string;
  readonly call: (given: Arguments) => Value;
  constructor(name: string, call: (given: Arguments) => Value) {
    this.name = name;
    this.call = call;
  }
}
/** Something with names inside: `math`, `xacro`, an included file's `ns`. */
export class Names {
  readonly name: string;
  readonly get: (name: string) => Value | undefined;
  constructor(name: string, get: (name: string) => Value | undefined) {
    this.name = name;
    this.get = get;
  }
}

/** What the value is called in a sentence. */
export function kindOf(value: Value): string {
  if (value === null) return "None";
  if (typeof value === "bigint") return "a whole number";
  if (value instanceof List) return "a list";
  if (value instanceof Dict) return "a dictionary";
  if (value instanceof Callable || value instanceof Names) return value.name;
  return { boolean: "a truth value", number: "a number", string: "a text" }[
    typeof value as "boolean" | "number" | "string"
  ];
}

export function isTrue(value: Value): boolean {
  if (value instanceof List) return value.items.length > 0;
  if (value instanceof Dict) return value.entries.size > 0;
  return Boolean(value);
}

/** As it stands in the text: `True`, `2.0`, `[1, 'a']`. */
export function textOf(value: Value): string {
  return typeof value === "string" ? value : representation(value, 0);
}

/** Deeper lists than this are not printed. */
const DEEPEST = 32;

function representation(value: Value, depth: number): string {
  if (depth > DEEPEST) throw new Refusal(`Lists are nested more than ${DEEPEST} deep.`);
  if (value === null) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value === "bigint") return String(value);
  if (typeof value === "number") return floatText(value);
  if (typeof value === "string")
    return value.includes("'") && !value.includes('"')
      ? `"${value}"`
      : `'${value.replaceAll("\\", "\\\\").replaceAll("'", "\\'")}'`;
  if (value instanceof List) {
    const inside = value.items.map(item => representation(item, depth + 1)).join(", ");
    return value.isTuple ? `(${inside}${value.items.length === 1 ? "," : ""})` : `[${inside}]`;
  }
  if (value instanceof Dict)
    return `{${[...value.entries].map(([key, item]) => `${representation(key, depth + 1)}: ${representation(item, depth + 1)}`).join(", ")}}`;
  throw new Refusal(`${value.name} stands where its value is expected.`);
}

/** The shortest digits that give the number back, laid out as Python does: 1e-05, 1e+16, 2.0. */
export function floatText(value: number): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "nan" : value > 0 ? "inf" : "-inf";
  if (Object.is(value, -0)) return "-0.0";
  if (value === 0) return "0.0";
  const [digits = "", power = "0"] = value.toExponential().split("e");
  const exponent = Number(power);
  if (exponent < -4 || exponent >= 16)
    return `${digits}e${exponent < 0 ? "-" : "+"}${String(Math.abs(exponent)).padStart(2, "0")}`;
  if (exponent >= 0) {
    const text = value.toFixed(Math.max(0, digits.replace(/[-.]/g, "").length - 1 - exponent));
    return text.includes(".") ? text : `${text}.0`;
  }
  return value.toFixed(Math.min(100, digits.replace(/[-.]/g, "").length - 1 - exponent));
}

const WHOLE = /^\s*[+-]?\d+\s*$/;
const REAL = /^\s*[+-]?((\d+\.?\d*|\.\d+)(e[+-]?\d+)?|inf|infinity|nan)\s*$/i;
export const wholeOf = (text: string): bigint | undefined =>
  WHOLE.test(text) && text.length < 400 ? BigInt(text.trim().replace("+", "")) : undefined;
export function realOf(text: string): number | undefined {
  if (!REAL.test(text)) return undefined;
  const plain = text.trim().toLowerCase();
  const sign = plain.startsWith("-") ? -1 : 1;
  return plain.includes("inf") ? sign * Infinity : plain.includes("nan") ? NaN : Number(plain);
}

/** A property's text as a number or truth value where it reads as one; quotes keep it a text. */
export function literalOf(text: string): Value {
  if (text.length >= 2 && text.startsWith("'") && text.endsWith("'")) return text.slice(1, -1);
  if (text.includes("_")) return text;
  const number = wholeOf(text) ?? realOf(text);
  return number ?? (text === "true" || text === "True" ? true : text === "false" || text === "False" ? false : text);
}

/** The value of a condition. */
export function truthOf(value: Value, written: string): boolean {
  if (typeof value !== "string") return isTrue(value);
  const literal = literalOf(value);
  if (typeof literal === "boolean" || typeof literal === "bigint") return Boolean(literal);
  throw new Refusal(`The condition “${shorten(written)}” became “${shorten(value)}”, which is neither true nor false.`);
}

/** A number of either kind, or nothing. Truth values count as 0 and 1. */
export const numberOf = (value: Value): number | undefined =>
  typeof value === "number"
    ? value
    : typeof value === "bigint" || typeof value === "boolean"
      ? Number(value)
      : undefined;
/** A whole number, or nothing. */
export const integerOf = (value: Value): bigint | undefined =>
  typeof value === "bigint" ? value : typeof value === "boolean" ? BigInt(value) : undefined;

export function equal(a: Value, b: Value): boolean {
  const x = numberOf(a);
  const y = numberOf(b);
  if (x !== undefined && y !== undefined) return typeof a === "bigint" && typeof b === "bigint" ? a === b : x === y;
  if (a instanceof List && b instanceof List)
    return (
      a.isTuple === b.isTuple &&
      a.items.length === b.items.length &&
      a.items.every((item, i) => equal(item, b.items[i]!))
    );
  if (a instanceof Dict && b instanceof Dict)
    return (
      a.entries.size === b.entries.size &&
      [...a.entries].every(([key, item]) => {
        const other = b.entries.get(key);
        return other !== undefined && equal(item, other);
      })
    );
  return a === b;
}

/** Negative, 0 or positive as a is before, with or after b; undefined when they have no order. */
export function order(a: Value, b: Value): number | undefined {
  const x = numberOf(a);
  const y = numberOf(b);
  if (x !== undefined && y !== undefined) return x < y ? -1 : x > y ? 1 : x === y ? 0 : NaN;
  if (typeof a === "string" && typeof b === "string") return a < b ? -1 : a > b ? 1 : 0;
  if (a instanceof List && b instanceof List) {
    for (let i = 0; i < Math.min(a.items.length, b.items.length); i++) {
      if (!equal(a.items[i]!, b.items[i]!)) return order(a.items[i]!, b.items[i]!);
    }
    return a.items.length - b.items.length;
  }
  return undefined;
}

/** 1, 1.0 and True are one key. */
export function keyOf(value: Value): string | bigint | number | boolean | null {
  if (typeof value === "number" && Number.isInteger(value)) return BigInt(value);
  if (typeof value === "boolean") return BigInt(value);
  if (value === null || typeof value === "string" || typeof value === "bigint" || typeof value === "number")
    return value;
  throw new Refusal(`${kindOf(value)} cannot be a key of a dictionary.`);
}

/** What can be gone through one by one. */
export function itemsOf(value: Value): readonly Value[] {
  if (value instanceof List) return value.items;
  if (value instanceof Dict) return [...value.entries.keys()];
  if (typeof value === "string") return [...value];
  throw new Refusal(`${sentenceCase(kindOf(value))} has no items.`);
}

export const sentenceCase = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);
