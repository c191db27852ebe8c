import { Refusal } from "../../refusal.ts";
import type { Budget } from "../budget.ts";
import { fixed } from "./rounding.ts";
import {
  Callable,
  Dict,
  integerOf,
  isTrue,
  itemsOf,
  keyOf,
  kindOf,
  List,
  Names,
  numberOf,
  order,
  realOf,
  sentenceCase,
  textOf,
  wholeOf,
  type Arguments,
  type Value,
} from "./values.ts";

const CONSTANTS: readonly (readonly [string, number])[] = [
  ["pi", Math.PI],
  ["e", Math.E],
  ["tau", 2 * Math.PI],
  ["inf", Infinity],
  ["nan", NaN],
];
const RADIANS_PER_DEGREE = Math.PI / 180;

/** Functions of numbers; what has no answer (√−1) is said, not NaN. */
const OF_NUMBERS: readonly (readonly [string, number, (a: number, b: number) => number])[] = [
  ["sin", 1, Math.sin],
  ["cos", 1, Math.cos],
  ["tan", 1, Math.tan],
  ["asin", 1, Math.asin],
  ["acos", 1, Math.acos],
  ["atan", 1, Math.atan],
  ["atan2", 2, Math.atan2],
  ["sinh", 1, Math.sinh],
  ["cosh", 1, Math.cosh],
  ["tanh", 1, Math.tanh],
  ["sqrt", 1, Math.sqrt],
  ["exp", 1, Math.exp],
  ["log10", 1, Math.log10],
  ["log2", 1, Math.log2],
  ["pow", 2, Math.pow],
  ["fabs", 1, Math.abs],
  ["fmod", 2, (a, b) => a % b],
  ["radians", 1, a => a * RADIANS_PER_DEGREE],
  ["degrees", 1, a => a * (180 / Math.PI)],
  ["copysign", 2, (a, b) => (b < 0 || Object.is(b, -0) ? -Math.abs(a) : Math.abs(a))],
];
const ROUNDING: readonly (readonly [string, (a: number) => number])[] = [
  ["floor", Math.floor],
  ["ceil", Math.ceil],
  ["trunc", Math.trunc],
];

const numberArgument = (given: Arguments, at: number, name: string): number => {
  const value = given.values[at];
  const number = value === undefined ? undefined : numberOf(value);
  if (number === undefined)
    throw new Refusal(
      value === undefined
        ? `${name}() wants ${at + 1} ${at === 0 ? "number" : "numbers"}.`
        : `${name}() wants a number, not ${kindOf(value)}.`,
    );
  return number;
};
const first = ({ values }: Arguments, name: string): Value => {
  const value = values[0];
  if (value === undefined) throw new Refusal(`${name}() wants a value.`);
  return value;
};

/** `math.…`, each also by its bare name. */
export function mathFunctions(): Map<string, Value> {
  const names = new Map<string, Value>(CONSTANTS);
  const define = (name: string, call: (given: Arguments) => Value): void => {
    names.set(name, new Callable(`${name}()`, call));
  };
  for (const [name, count, compute] of OF_NUMBERS) {
    define(name, given => {
      if (given.values.length !== count)
        throw new Refusal(
          `${name}() wants ${count} ${count === 1 ? "number" : "numbers"}, not ${given.values.length}.`,
        );
      const a = numberArgument(given, 0, name);
      const b = count > 1 ? numberArgument(given, 1, name) : 0;
      const result = compute(a, b);
      if (Number.isNaN(result) && !Number.isNaN(a) && !Number.isNaN(b))
        throw new Refusal(`${name}() has no value at ${a}${count > 1 ? `, ${b}` : ""}.`);
      return result;
    });
  }
  for (const [name, compute] of ROUNDING)
    define(name, given => integerOf(first(given, name)) ?? wholeNumber(compute(numberArgument(given, 0, name)), name));
  define("log", given => {
    const value = numberArgument(given, 0, "log");
    const base = given.values.length > 1 ? Math.log(numberArgument(given, 1, "log")) : 1;
    if (!(value > 0)) throw new Refusal(`log() has no value at ${value}.`);
    return Math.log(value) / base;
  });
  define("hypot", given => Math.hypot(...given.values.map((_, i) => numberArgument(given, i, "hypot"))));
  define("isnan", given => Number.isNaN(numberArgument(given, 0, "isnan")));
  define("isinf", given => Math.abs(numberArgument(given, 0, "isinf")) === Infinity);
  return names;
}

function wholeNumber(value: number, name: string): bigint {
  if (!Number.isFinite(value)) throw new Refusal(`${name}() cannot make a whole number of ${value}.`);
  return BigInt(value);
}

/** `len`, `str`, `float` and their kin. */
export function plainFunctions(budget: Budget): Map<string, Value> {
  const names = new Map<string, Value>();
  const define = (name: string, call: (given: Arguments) => Value): void => {
    names.set(name, new Callable(`${name}()`, call));
  };
  define("str", ({ values }) => (values[0] === undefined ? "" : textOf(values[0])));
  define("bool", ({ values }) => values[0] !== undefined && isTrue(values[0]));
  define("float", given => {
    const value = given.values[0] ?? 0;
    const number = typeof value === "string" ? realOf(value) : numberOf(value);
    if (number === undefined) throw new Refusal(`float() cannot make a number of “${textOf(value).slice(0, 40)}”.`);
    return number;
  });
  define("int", given => {
    const value = given.values[0] ?? 0n;
    const whole = typeof value === "string" ? wholeOf(value) : integerOf(value);
    if (whole !== undefined) return whole;
    if (typeof value !== "number")
      throw new Refusal(`int() cannot make a whole number of “${textOf(value).slice(0, 40)}”.`);
    return wholeNumber(Math.trunc(value), "int");
  });
  define("len", given => BigInt(itemsOf(first(given, "len")).length));
  define("abs", given => {
    const value = first(given, "abs");
    const whole = integerOf(value);
    return whole === undefined ? Math.abs(numberArgument(given, 0, "abs")) : whole < 0n ? -whole : whole;
  });
  define("round", given => rounded(first(given, "round"), given.values[1]));
  define("min", given => extreme(given, "min", -1));
  define("max", given => extreme(given, "max", 1));
  define("sum", given => {
    const items = itemsOf(first(given, "sum"));
    if (items.every(item => integerOf(item) !== undefined))
      return items.reduce<bigint>((sum, item) => sum + integerOf(item)!, 0n);
    return items.reduce<number>(
      (sum, item) => sum + numberArgument({ values: [item], named: given.named }, 0, "sum"),
      0,
    );
  });
  define("list", ({ values }) => new List(values[0] === undefined ? [] : itemsOf(values[0])));
  define("tuple", ({ values }) => new List(values[0] === undefined ? [] : itemsOf(values[0]), true));
  define("sorted", given => {
    const items = [...itemsOf(first(given, "sorted"))].sort((a, b) => order(a, b) ?? 0);
    return new List(isTrue(given.named.get("reverse") ?? false) ? items.reverse() : items);
  });
  define("reversed", given => new List([...itemsOf(first(given, "reversed"))].reverse()));
  define("all", given => itemsOf(first(given, "all")).every(isTrue));
  define("any", given => itemsOf(first(given, "any")).some(isTrue));
  define(
    "enumerate",
    given => new List(itemsOf(first(given, "enumerate")).map((item, i) => new List([BigInt(i), item], true))),
  );
  define("zip", ({ values }) => {
    const lists = values.map(itemsOf);
    const length = lists.length === 0 ? 0 : Math.min(...lists.map(list => list.length));
    return new List(
      Array.from(
        { length },
        (_, i) =>
          new List(
            lists.map(list => list[i]!),
            true,
          ),
      ),
    );
  });
  define("range", ({ values }) =>
    range(
      values.map(value => integerOf(value)),
      budget,
    ),
  );
  define("dict", ({ values, named }) => {
    const given = values[0];
    const pairs =
      given instanceof Dict
        ? [...given.entries]
        : given === undefined
          ? []
          : itemsOf(given).map(pair => {
              const [key = null, value = null] = itemsOf(pair);
              return [keyOf(key), value] as const;
            });
    return new Dict(new Map([...pairs, ...named]));
  });
  define("map", ({ values }) => {
    const [over, items] = values;
    if (!(over instanceof Callable) || items === undefined) throw new Refusal("map() wants a function and a list.");
    return new List(itemsOf(items).map(item => over.call({ values: [item], named: new Map() })));
  });
  return names;
}

function range(bounds: readonly (bigint | undefined)[], budget: Budget): List {
  if (bounds.length === 0 || bounds.length > 3 || bounds.includes(undefined))
    throw new Refusal("range() wants one to three whole numbers.");
  const [from, to, step = 1] = (bounds.length === 1 ? [0n, bounds[0]] : bounds).map(Number);
  if (step === 0) throw new Refusal("range() wants a step other than 0.");
  const count = Math.max(0, Math.ceil((to! - from!) / step));
  budget.spend(count);
  return new List(Array.from({ length: count }, (_, i) => BigInt(from! + i * step)));
}

function extreme({ values }: Arguments, name: string, sign: number): Value {
  const items = values.length === 1 ? itemsOf(values[0]!) : values;
  if (items.length === 0) throw new Refusal(`${name}() wants at least one value.`);
  return items.reduce((best, item) => {
    const compared = order(item, best);
    if (compared === undefined) throw new Refusal(`${sentenceCase(kindOf(item))} and ${kindOf(best)} have no order.`);
    return compared * sign > 0 ? item : best;
  });
}

/** To the nearest, halves to the even neighbour; without places a whole number. */
function rounded(value: Value, places: Value | undefined): Value {
  const whole = integerOf(value);
  const number = numberOf(value);
  if (whole !== undefined) return whole;
  if (number === undefined) throw new Refusal(`round() wants a number, not ${kindOf(value)}.`);
  const digits = places === undefined || places === null ? 0 : Number(integerOf(places) ?? 0n);
  if (!Number.isFinite(number)) throw new Refusal(`round() wants a finite number, not ${number}.`);
  if (digits < 0 || digits > 60 || Math.abs(number) >= 1e21) return number;
  const result = Number(fixed(number, digits));
  return places === undefined || places === null ? BigInt(result) : result;
}

/** A group of names, such as `math`. */
export const namesOf = (name: string, names: ReadonlyMap<string, Value>): Names =>
  new Names(name, key => names.get(key));
