import { ScriptError, type At } from "./fault.ts";

/** What a variable holds. A pose is six numbers that know they are one; a thread is its number. */
export type Value = number | boolean | string | readonly Value[] | PoseValue | null;
export interface PoseValue {
  readonly pose: readonly number[];
}
export const isPose = (value: Value): value is PoseValue =>
  typeof value === "object" && value !== null && "pose" in value;
export const isList = (value: Value): value is readonly Value[] => Array.isArray(value);

export const kindOf = (value: Value): string =>
  value === null
    ? "nothing"
    : typeof value === "number"
      ? "a number"
      : typeof value === "boolean"
        ? "True or False"
        : typeof value === "string"
          ? "a text"
          : isPose(value)
            ? "a pose"
            : "a list";
const wrong = (value: Value, wanted: string, at: At): ScriptError =>
  new ScriptError(at, `${wanted} is expected, and ${kindOf(value)} is given.`);

export function asNumber(value: Value, at: At): number {
  if (typeof value === "number") return value;
  throw wrong(value, "A number", at);
}
export function asTruth(value: Value, at: At): boolean {
  if (typeof value === "boolean") return value;
  throw wrong(value, "True or False", at);
}
/** The numbers of a pose or a list; as many as wanted. */
export function asNumbers(value: Value, count: number | undefined, at: At): readonly number[] {
  const numbers = isPose(value) ? value.pose : isList(value) ? value.map(item => asNumber(item, at)) : undefined;
  if (!numbers) throw wrong(value, count === undefined ? "A list" : `A list of ${count} numbers`, at);
  if (count !== undefined && numbers.length !== count)
    throw new ScriptError(at, `${count} numbers are expected, and ${numbers.length} are given.`);
  return numbers;
}
export function asPose(value: Value, at: At): readonly number[] {
  if (isPose(value)) return value.pose;
  throw wrong(value, "A pose", at);
}
export const asText = (value: Value): string =>
  value === null
    ? ""
    : typeof value === "boolean"
      ? value
        ? "True"
        : "False"
      : isPose(value)
        ? `p[${value.pose.join(", ")}]`
        : isList(value)
          ? `[${value.map(asText).join(", ")}]`
          : String(value);

const finite = (value: number, at: At): number => {
  if (Number.isFinite(value)) return value;
  throw new ScriptError(at, "The result is no number.");
};
function arithmetic(sign: string, a: number, b: number, at: At): number {
  switch (sign) {
    case "+":
      return finite(a + b, at);
    case "-":
      return finite(a - b, at);
    case "*":
      return finite(a * b, at);
    case "/":
      if (b === 0) throw new ScriptError(at, "The divisor is 0.");
      return finite(a / b, at);
    default:
      if (b === 0) throw new ScriptError(at, "The divisor is 0.");
      return a % b;
  }
}

function same(a: Value, b: Value): boolean {
  if (isPose(a) && isPose(b)) return a.pose.every((value, i) => value === b.pose[i]);
  if (isList(a) && isList(b)) return a.length === b.length && a.every((value, i) => same(value, b[i]!));
  return a === b;
}

/** An operator between two values. Lists add and subtract item by item, and a number scales them. */
export function binary(sign: string, a: Value, b: Value, at: At): Value {
  switch (sign) {
    case "==":
      return same(a, b);
    case "!=":
      return !same(a, b);
    case "<":
      return asNumber(a, at) < asNumber(b, at);
    case ">":
      return asNumber(a, at) > asNumber(b, at);
    case "<=":
      return asNumber(a, at) <= asNumber(b, at);
    case ">=":
      return asNumber(a, at) >= asNumber(b, at);
    case "and":
      return asTruth(a, at) && asTruth(b, at);
    case "or":
      return asTruth(a, at) || asTruth(b, at);
    case "xor":
      return asTruth(a, at) !== asTruth(b, at);
    default:
  }
  if (typeof a === "number" && typeof b === "number") return arithmetic(sign, a, b, at);
  if (sign === "+" && typeof a === "string" && typeof b === "string") return a + b;
  if ((sign === "+" || sign === "-") && isList(a) && isList(b)) {
    const right = asNumbers(b, a.length, at);
    return asNumbers(a, undefined, at).map((value, i) => arithmetic(sign, value, right[i]!, at));
  }
  if (isList(a) && (sign === "*" || sign === "/") && typeof b === "number")
    return asNumbers(a, undefined, at).map(value => arithmetic(sign, value, b, at));
  if (isList(b) && sign === "*" && typeof a === "number")
    return asNumbers(b, undefined, at).map(value => arithmetic(sign, a, value, at));
  throw new ScriptError(at, `"${sign}" does not join ${kindOf(a)} and ${kindOf(b)}.`);
}

export function itemOf(of: Value, index: Value, at: At): Value {
  const items: readonly Value[] = isPose(of) ? of.pose : isList(of) ? of : [];
  const i = asNumber(index, at);
  if (!isPose(of) && !isList(of)) throw new ScriptError(at, `${kindOf(of)} has no items.`);
  if (!Number.isInteger(i) || i < 0 || i >= items.length)
    throw new ScriptError(at, `There is no item ${i} in ${items.length}.`);
  return items[i]!;
}
export function withItem(of: Value, index: Value, item: Value, at: At): Value {
  itemOf(of, index, at);
  const i = asNumber(index, at);
  if (isPose(of)) {
    const number = asNumber(item, at);
    return { pose: of.pose.map((old, k) => (k === i ? number : old)) };
  }
  return (of as readonly Value[]).map((old, k) => (k === i ? item : old));
}
