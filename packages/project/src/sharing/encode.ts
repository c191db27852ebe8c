import * as Y from "yjs";
import { isRecord, keyOf, same, unitsOf, type Json, type Layout } from "./layout.ts";
import { longestRising, orderBetween, ordersFor } from "./order.ts";
import { changeText } from "./text.ts";

/** Where a thing of a list keeps its place. No field of a cell begins so. */
export const ORDER = "#order";
/** What a table that is a list says of itself. */
const LIST = "#list";
type Node = Y.Map<unknown>;
/**
 * Lists and tables that a cell may leave out. In a shared document they are there from the beginning: two people who
 * each add the first thing of one put it into the same.
 */
const MAY_BE_LEFT_OUT: ReadonlySet<string> = new Set([
  "sensors",
  "people",
  "zones",
  "comments",
  "variables",
  "parameters",
]);
const emptyOf = (layout: Layout): unknown => (layout.kind === "list" || layout.kind === "set" ? [] : {});

/** Makes names that no other editor makes, and the digits by which an editor's places differ from others'. */
export interface Namer {
  newKey(): string;
  readonly mark: string;
}

/** Keys of the things of a list, in their order. */
export function keysInOrder(list: Node): readonly string[] {
  const placed: [order: string, key: string][] = [];
  for (const [key, item] of list) if (item instanceof Y.Map) placed.push([String(item.get(ORDER)), key]);
  placed.sort(([a, x], [b, y]) => (a < b ? -1 : a > b ? 1 : x < y ? -1 : x > y ? 1 : 0));
  return placed.map(([, key]) => key);
}

/** A value as it is kept in a shared document. */
function encoded(value: unknown, layout: Layout, namer: Namer): unknown {
  const map = new Y.Map<unknown>();
  switch (layout.kind) {
    case "text":
      return typeof value === "string" ? new Y.Text(value) : value;
    case "record":
      if (!isRecord(value)) return value;
      for (const unit of unitsOf(layout, Object.keys(value))) {
        const part = partOf(value, unit.fields);
        if (part !== undefined) map.set(unit.key, encoded(part, unit.layout, namer));
      }
      for (const [name, inside] of Object.entries(layout.fields))
        if (MAY_BE_LEFT_OUT.has(name) && value[name] === undefined)
          map.set(name, encoded(emptyOf(inside), inside, namer));
      return map;
    case "table":
      if (!isRecord(value)) return value;
      for (const [name, entry] of Object.entries(value)) map.set(name, encoded(entry, layout.entry, namer));
      return map;
    case "list": {
      if (!Array.isArray(value)) return value;
      map.set(LIST, true);
      const orders = ordersFor(value.length);
      for (const [i, item] of value.entries()) {
        const node = encoded(item, layout.item, namer) as Node;
        node.set(ORDER, orders[i]!);
        map.set(namer.newKey(), node);
      }
      return map;
    }
    case "set":
      if (!Array.isArray(value)) return value;
      for (const each of value) map.set(JSON.stringify(each), true);
      return map;
    case "value":
      return value;
  }
}

/** The value of one unit: the field itself, or the fields that belong together. */
export function partOf(value: Json, fields: readonly string[]): unknown {
  if (fields.length === 1) return value[fields[0]!];
  const part = Object.fromEntries(
    fields.filter(field => value[field] !== undefined).map(field => [field, value[field]]),
  );
  return Object.keys(part).length === 0 ? undefined : part;
}

/**
 * Writes what is different between two states of a value, and nothing else, so that what others change at the same time
 * stays.
 *
 * @param before  the value as `decode` gives it now.
 */
export function writeChanges(
  node: Y.Map<unknown>,
  layout: Layout,
  before: unknown,
  after: unknown,
  namer: Namer,
): void {
  if (before === after) return;
  switch (layout.kind) {
    case "record": {
      const was = before as Json;
      const is = after as Json;
      for (const unit of unitsOf(layout, [...Object.keys(was), ...Object.keys(is)]))
        writeEntry(node, unit.key, unit.layout, partOf(was, unit.fields), partOf(is, unit.fields), namer);
      return;
    }
    case "table": {
      const was = before as Json;
      const is = after as Json;
      for (const name of new Set([...Object.keys(was), ...Object.keys(is)]))
        writeEntry(node, name, layout.entry, was[name], is[name], namer);
      return;
    }
    case "set": {
      const was = new Set((before as readonly unknown[]).map(each => JSON.stringify(each)));
      const is = new Set((after as readonly unknown[]).map(each => JSON.stringify(each)));
      for (const each of was) if (!is.has(each)) node.delete(each);
      for (const each of is) if (!was.has(each)) node.set(each, true);
      return;
    }
    case "list":
      writeList(node, layout.item, before as readonly unknown[], after as readonly unknown[], namer);
      return;
    case "value":
    case "text":
      return;
  }
}

function writeEntry(parent: Node, key: string, layout: Layout, before: unknown, after: unknown, namer: Namer): void {
  if (before === after || same(before, after)) return;
  const kept = parent.get(key);
  if (kept instanceof Y.Map && MAY_BE_LEFT_OUT.has(key))
    writeChanges(kept, layout, before ?? emptyOf(layout), after ?? emptyOf(layout), namer);
  else if (after === undefined) parent.delete(key);
  else if (kept instanceof Y.Map && goesInto(layout, before, after)) writeChanges(kept, layout, before, after, namer);
  else if (kept instanceof Y.Text && layout.kind === "text" && typeof before === "string" && typeof after === "string")
    changeText(kept, before, after);
  else parent.set(key, encoded(after, layout, namer));
}
const goesInto = (layout: Layout, before: unknown, after: unknown): boolean =>
  layout.kind === "list" || layout.kind === "set"
    ? Array.isArray(before) && Array.isArray(after)
    : isRecord(before) && isRecord(after);

function writeList(
  list: Node,
  layout: Layout,
  before: readonly unknown[],
  after: readonly unknown[],
  namer: Namer,
): void {
  const keys = keysInOrder(list);
  // Of what a cell is given where nothing was kept, as its one empty program, there is no trace in the document.
  const was = keys.length === before.length ? before : [];
  const places = new Map(was.map((item, i) => [keyOf(item), i]));
  const matched = after.map(item => places.get(keyOf(item)) ?? -1);
  renamed(was, after, matched);
  const kept = new Set(matched);
  for (const [i] of was.entries()) if (!kept.has(i)) list.delete(keys[i]!);
  const resting = longestRising(matched.filter(place => place >= 0));
  const orderAt = (i: number): string => String((list.get(keys[i]!) as Node).get(ORDER));
  let last = "";
  for (const [i, item] of after.entries()) {
    const place = matched[i]!;
    if (resting.has(place)) {
      last = orderAt(place);
      writeChanges(list.get(keys[place]!) as Node, layout, was[place], item, namer);
      continue;
    }
    const next = matched.slice(i + 1).find(each => resting.has(each));
    const order = orderBetween(last, next === undefined ? undefined : orderAt(next), namer.mark);
    if (place >= 0) {
      const node = list.get(keys[place]!) as Node;
      writeChanges(node, layout, was[place], item, namer);
      node.set(ORDER, order);
    } else {
      const node = encoded(item, layout, namer) as Node;
      node.set(ORDER, order);
      list.set(namer.newKey(), node);
    }
    last = order;
  }
}

/** A thing that has another name at the same place is the same thing: what others change in it stays. */
function renamed(was: readonly unknown[], after: readonly unknown[], matched: number[]): void {
  if (was.length !== after.length) return;
  const found = new Set(matched);
  for (const [i, place] of matched.entries()) if (place < 0 && !found.has(i)) matched[i] = i;
}

/** The value of a node, from what was read before where nothing in it changed. */
export function decode(node: unknown, layout: Layout, known: WeakMap<object, unknown>): unknown {
  if (!(node instanceof Y.AbstractType)) return node;
  const before = known.get(node);
  if (before !== undefined) return before;
  const value = decodeFresh(node as Y.AbstractType<unknown>, layout, known);
  known.set(node, value);
  return value;
}

function decodeFresh(node: Y.AbstractType<unknown>, layout: Layout, known: WeakMap<object, unknown>): unknown {
  if (node instanceof Y.Text) return node.toString();
  if (!(node instanceof Y.Map)) return null;
  const map = node as Node;
  switch (layout.kind) {
    case "list":
      return keysInOrder(map).map(key => decode(map.get(key), layout.item, known));
    case "set":
      return [...map.keys()].toSorted().map(text => JSON.parse(text) as unknown);
    case "table":
      return Object.fromEntries(
        [...map.keys()].toSorted().map(name => [name, decode(map.get(name), layout.entry, known)]),
      );
    case "record": {
      const fields: Record<string, unknown> = {};
      for (const key of [...map.keys()].toSorted()) {
        if (key === ORDER || key === LIST) continue;
        const names = key.split("+");
        const part = decode(map.get(key), layout.fields[key] ?? { kind: "value" }, known);
        if (MAY_BE_LEFT_OUT.has(key) && isEmpty(part)) continue;
        if (names.length === 1) fields[key] = part;
        else Object.assign(fields, part);
      }
      return fields;
    }
    case "value":
    case "text":
      return map.toJSON();
  }
}

const isEmpty = (part: unknown): boolean =>
  Array.isArray(part) ? part.length === 0 : isRecord(part) && Object.keys(part).length === 0;
