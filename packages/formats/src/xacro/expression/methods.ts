import { Refusal } from "../../refusal.ts";
import type { Budget } from "../budget.ts";
import { formatBraces } from "./format.ts";
import { Callable, Dict, equal, itemsOf, keyOf, kindOf, List, textOf, type Arguments, type Value } from "./values.ts";

type Method<T> = (self: T, given: Arguments, budget: Budget) => Value;

const textArgument = ({ values }: Arguments, at: number, method: string): string => {
  const value = values[at];
  if (typeof value !== "string")
    throw new Refusal(`${method}() wants a text${value === undefined ? "" : `, not ${kindOf(value)}`}.`);
  return value;
};
const trimmed = (self: string, { values }: Arguments, front: boolean, back: boolean): string => {
  const letters = values[0] === undefined || values[0] === null ? undefined : textOf(values[0]);
  const drop = (letter: string): boolean => (letters === undefined ? letter.trim() === "" : letters.includes(letter));
  let from = 0;
  let to = self.length;
  while (front && from < to && drop(self.charAt(from))) from++;
  while (back && to > from && drop(self.charAt(to - 1))) to--;
  return self.slice(from, to);
};

const OF_TEXT = new Map<string, Method<string>>([
  ["lower", self => self.toLowerCase()],
  ["upper", self => self.toUpperCase()],
  [
    "title",
    self =>
      self
        .toLowerCase()
        .replace(/(^|[^a-z])([a-z])/g, (_, before: string, letter: string) => before + letter.toUpperCase()),
  ],
  ["capitalize", self => self.charAt(0).toUpperCase() + self.slice(1).toLowerCase()],
  ["strip", (self, given) => trimmed(self, given, true, true)],
  ["lstrip", (self, given) => trimmed(self, given, true, false)],
  ["rstrip", (self, given) => trimmed(self, given, false, true)],
  ["startswith", (self, given) => self.startsWith(textArgument(given, 0, "startswith"))],
  ["endswith", (self, given) => self.endsWith(textArgument(given, 0, "endswith"))],
  ["find", (self, given) => BigInt(self.indexOf(textArgument(given, 0, "find")))],
  ["count", (self, given) => BigInt(self.split(textArgument(given, 0, "count")).length - 1)],
  ["isdigit", self => /^\d+$/.test(self)],
  [
    "replace",
    (self, given, budget) => {
      const from = textArgument(given, 0, "replace");
      const to = textArgument(given, 1, "replace");
      const pieces = self.split(from);
      budget.spend(self.length + pieces.length * to.length);
      return pieces.join(to);
    },
  ],
  [
    "split",
    (self, given, budget) => {
      const by = given.values[0] ?? null;
      const pieces =
        by === null
          ? self
              .trim()
              .split(/\s+/)
              .filter(piece => piece !== "")
          : self.split(textArgument(given, 0, "split"));
      budget.spend(pieces.length);
      return new List(pieces);
    },
  ],
  [
    "join",
    (self, given, budget) => {
      const text = itemsOf(given.values[0] ?? null)
        .map(textOf)
        .join(self);
      budget.spend(text.length);
      return text;
    },
  ],
  ["format", (self, given, budget) => formatBraces(self, given.values, given.named, budget)],
]);

const OF_LIST = new Map<string, Method<List>>([
  [
    "index",
    (self, { values }) => {
      const at = self.items.findIndex(item => equal(item, values[0] ?? null));
      if (at < 0) throw new Refusal("index() asks for an item that is not in the list.");
      return BigInt(at);
    },
  ],
  ["count", (self, { values }) => BigInt(self.items.filter(item => equal(item, values[0] ?? null)).length)],
]);

const OF_DICT = new Map<string, Method<Dict>>([
  ["get", (self, { values }) => self.entries.get(keyOf(values[0] ?? null)) ?? values[1] ?? null],
  ["keys", self => new List([...self.entries.keys()])],
  ["values", self => new List([...self.entries.values()])],
  ["items", self => new List([...self.entries].map(pair => new List(pair, true)))],
]);

/** The method of that name bound to its value, if there is one. */
export function methodOf(self: Value, name: string, budget: Budget): Callable | undefined {
  const bound = <T>(method: Method<T> | undefined, of: T): Callable | undefined =>
    method && new Callable(`${name}()`, given => method(of, given, budget));
  if (typeof self === "string") return bound(OF_TEXT.get(name), self);
  if (self instanceof List) return bound(OF_LIST.get(name), self);
  if (self instanceof Dict) return bound(OF_DICT.get(name), self);
  return undefined;
}
