import { Refusal } from "../../refusal.ts";
import { shorten } from "../../xml.ts";
import type { Budget } from "../budget.ts";
import { binary, unary } from "./arithmetic.ts";
import { methodOf } from "./methods.ts";
import type { Node } from "./syntax.ts";
import {
  Callable,
  Dict,
  equal,
  integerOf,
  isTrue,
  itemsOf,
  keyOf,
  kindOf,
  List,
  Names,
  order,
  sentenceCase,
  textOf,
  type Value,
} from "./values.ts";

/** What a name stands for, or undefined. */
export type Lookup = (name: string) => Value | undefined;

/** The value of an expression. @throws {Refusal} with what cannot be worked out. */
export function evaluate(node: Node, lookup: Lookup, budget: Budget): Value {
  budget.spend(1);
  const value = (inner: Node): Value => evaluate(inner, lookup, budget);
  switch (node.kind) {
    case "value":
      return node.value;
    case "name": {
      if (node.name.startsWith("__")) throw new Refusal(`The name ${shorten(node.name)} may not be used.`);
      const found = lookup(node.name);
      if (found === undefined) throw new Refusal(`The name ${shorten(node.name)} is not defined.`);
      return found;
    }
    case "list":
      return new List(node.items.map(value), node.isTuple);
    case "dict":
      return new Dict(new Map(node.entries.map(([key, item]) => [keyOf(value(key)), value(item)])));
    case "each":
      return each(node, lookup, budget);
    case "choice":
      return value(isTrue(value(node.condition)) ? node.yes : node.no);
    case "both": {
      const left = value(node.left);
      return isTrue(left) ? value(node.right) : left;
    }
    case "either": {
      const left = value(node.left);
      return isTrue(left) ? left : value(node.right);
    }
    case "unary":
      return unary(node.operator, value(node.operand));
    case "binary":
      return binary(node.operator, value(node.left), value(node.right), budget);
    case "comparison": {
      let left = value(node.first);
      for (const { operator, with: other } of node.rest) {
        const right = value(other);
        if (!compare(operator, left, right)) return false;
        left = right;
      }
      return true;
    }
    case "member":
      return memberOf(value(node.of), node.name, budget);
    case "item":
      return itemAt(value(node.of), value(node.at));
    case "slice":
      return slice(
        value(node.of),
        [node.from, node.to, node.step].map(part => (part ? value(part) : null)),
        budget,
      );
    case "call": {
      const called = value(node.of);
      if (!(called instanceof Callable))
        throw new Refusal(`${sentenceCase(kindOf(called))} is called like a function.`);
      return called.call({
        values: node.values.map(value),
        named: new Map(node.named.map(([name, given]) => [name, value(given)])),
      });
    }
  }
}

function each(node: Extract<Node, { kind: "each" }>, lookup: Lookup, budget: Budget): List {
  const results: Value[] = [];
  for (const item of itemsOf(evaluate(node.over, lookup, budget))) {
    const parts = node.names.length === 1 ? [item] : itemsOf(item);
    if (parts.length !== node.names.length)
      throw new Refusal(`${node.names.length} names are to take ${parts.length} values.`);
    const inner: Lookup = name => {
      const at = node.names.indexOf(name);
      return at >= 0 ? parts[at] : lookup(name);
    };
    if (node.only.every(condition => isTrue(evaluate(condition, inner, budget))))
      results.push(evaluate(node.result, inner, budget));
  }
  return new List(results);
}

function compare(operator: string, a: Value, b: Value): boolean {
  switch (operator) {
    case "==":
      return equal(a, b);
    case "!=":
      return !equal(a, b);
    case "is":
      return a === b;
    case "is not":
      return a !== b;
    case "in":
      return contains(b, a);
    case "not in":
      return !contains(b, a);
  }
  const sign = order(a, b);
  if (sign === undefined)
    throw new Refusal(`${sentenceCase(kindOf(a))} and ${kindOf(b)} have no order: “${operator}” cannot compare them.`);
  return operator === "<" ? sign < 0 : operator === "<=" ? sign <= 0 : operator === ">" ? sign > 0 : sign >= 0;
}

function contains(whole: Value, part: Value): boolean {
  if (typeof whole === "string" && typeof part === "string") return whole.includes(part);
  if (whole instanceof Dict) return whole.entries.has(keyOf(part));
  return itemsOf(whole).some(item => equal(item, part));
}

/** `a.b`: a method, else what a dictionary or a group of names holds under that name. */
export function memberOf(of: Value, name: string, budget: Budget): Value {
  if (name.startsWith("__")) throw new Refusal(`The name ${shorten(name)} may not be used.`);
  const found =
    methodOf(of, name, budget) ??
    (of instanceof Dict ? of.entries.get(name) : of instanceof Names ? of.get(name) : undefined);
  if (found === undefined)
    throw new Refusal(
      of instanceof Dict
        ? `The dictionary has no key ${shorten(name)}.`
        : `${sentenceCase(kindOf(of))} has no ${shorten(name)}.`,
    );
  return found;
}

function itemAt(of: Value, at: Value): Value {
  if (of instanceof Dict) {
    const found = of.entries.get(keyOf(at));
    if (found === undefined) throw new Refusal(`The dictionary has no key ${shorten(textOf(at))}.`);
    return found;
  }
  if (of instanceof Names && typeof at === "string")
    return (
      of.get(at) ??
      (() => {
        throw new Refusal(`${sentenceCase(of.name)} has no ${shorten(at)}.`);
      })()
    );
  const items = itemsOf(of);
  const whole = integerOf(at);
  if (whole === undefined) throw new Refusal(`${sentenceCase(kindOf(at))} cannot count the items of ${kindOf(of)}.`);
  const index = Number(whole);
  const found = items[index < 0 ? items.length + index : index];
  if (found === undefined) throw new Refusal(`Item ${index} is asked of ${kindOf(of)} with ${items.length}.`);
  return found;
}

function slice(of: Value, bounds: readonly Value[], budget: Budget): Value {
  const [from, to, step = 1] = bounds.map(bound => {
    const whole = bound === null ? undefined : integerOf(bound);
    if (bound !== null && whole === undefined)
      throw new Refusal(`${sentenceCase(kindOf(bound))} cannot bound a piece of ${kindOf(of)}.`);
    return whole === undefined ? undefined : Number(whole);
  });
  const items = itemsOf(of);
  const length = items.length;
  const results: Value[] = [];
  if (step === 0) throw new Refusal("A piece is taken with a step of 0.");
  const place = (bound: number | undefined, open: number): number => {
    if (bound === undefined) return open;
    const counted = bound < 0 ? bound + length : bound;
    return step > 0 ? Math.min(Math.max(counted, 0), length) : Math.min(Math.max(counted, -1), length - 1);
  };
  const first = place(from, step > 0 ? 0 : length - 1);
  const end = place(to, step > 0 ? length : -1);
  for (let i = first; step > 0 ? i < end : i > end; i += step) results.push(items[i]!);
  budget.spend(results.length);
  return typeof of === "string" ? results.map(textOf).join("") : new List(results, of instanceof List && of.isTuple);
}
