import type { CellDocument } from "../document.ts";
import { partOf } from "./encode.ts";
import { CELL_LAYOUT, isRecord, keyOf, same, unitsOf, type Json, type Layout } from "./layout.ts";

/**
 * What somebody changed between two states of a cell, done to a third state of it. What they changed is as they made
 * it; all else is as it is in the third. What is not there any more is not changed.
 */
export function graftChanges(before: CellDocument, after: CellDocument, onto: CellDocument): CellDocument {
  return graft(CELL_LAYOUT, before, after, onto) as unknown as CellDocument;
}

function graft(layout: Layout, before: unknown, after: unknown, onto: unknown): unknown {
  if (before === after || same(before, after)) return onto;
  switch (layout.kind) {
    case "record":
      return isRecord(before) && isRecord(after) && isRecord(onto) ? records(layout, before, after, onto) : after;
    case "table":
      return isRecord(before) && isRecord(after) && isRecord(onto) ? tables(layout.entry, before, after, onto) : after;
    case "list":
      return lists(layout.item, before, after, onto);
    case "set":
      return sets(before, after, onto);
    case "value":
    case "text":
      return after;
  }
}

function records(layout: Extract<Layout, { readonly kind: "record" }>, before: Json, after: Json, onto: Json): Json {
  const made = new Map(Object.entries(onto));
  for (const { fields, layout: inside } of unitsOf(layout, [...Object.keys(before), ...Object.keys(after)])) {
    const was = partOf(before, fields);
    const is = partOf(after, fields);
    if (same(was, is)) continue;
    const part = graft(inside, was, is, partOf(onto, fields));
    for (const field of fields) made.delete(field);
    if (fields.length > 1) for (const [field, value] of Object.entries(part ?? {})) made.set(field, value);
    else if (part !== undefined) made.set(fields[0]!, part);
  }
  return Object.fromEntries(made);
}

function tables(entry: Layout, before: Json, after: Json, onto: Json): Json {
  const made = new Map(Object.entries(onto));
  for (const name of new Set([...Object.keys(before), ...Object.keys(after)])) {
    if (same(before[name], after[name])) continue;
    const part = graft(entry, before[name], after[name], onto[name]);
    if (part === undefined) made.delete(name);
    else made.set(name, part);
  }
  return Object.fromEntries(made);
}

const listOf = (value: unknown): readonly unknown[] => (Array.isArray(value) ? value : []);

function sets(before: unknown, after: unknown, onto: unknown): unknown {
  const text = (each: unknown): string => JSON.stringify(each);
  const was = new Set(listOf(before).map(text));
  const is = new Set(listOf(after).map(text));
  const kept = listOf(onto).filter(each => !was.has(text(each)) || is.has(text(each)));
  const there = new Set(kept.map(text));
  return [...kept, ...listOf(after).filter(each => !was.has(text(each)) && !there.has(text(each)))];
}

function lists(layout: Layout, before: unknown, after: unknown, onto: unknown): unknown {
  const was = new Map(listOf(before).map(item => [keyOf(item), item]));
  const is = listOf(after);
  const isKeys = new Set(is.map(keyOf));
  const made = listOf(onto).filter(item => !was.has(keyOf(item)) || isKeys.has(keyOf(item)));
  const reordered =
    listOf(before)
      .map(keyOf)
      .filter(key => isKeys.has(key))
      .join("\n") !==
    is
      .map(keyOf)
      .filter(key => was.has(key))
      .join("\n");
  for (const [i, item] of is.entries()) {
    const key = keyOf(item);
    const old = was.get(key);
    const at = made.findIndex(each => keyOf(each) === key);
    if (old !== undefined && at < 0) continue; // Somebody took it out meanwhile.
    const next = at < 0 ? item : graft(layout, old ?? made[at], item, made[at]);
    if (at >= 0 && !reordered) {
      made[at] = next;
      continue;
    }
    if (at >= 0) made.splice(at, 1);
    const previous = i === 0 ? -1 : made.findIndex(each => keyOf(each) === keyOf(is[i - 1]));
    made.splice(previous + 1, 0, next);
  }
  return made;
}
