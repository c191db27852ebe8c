/** How a part of a cell is kept in a shared document: what is merged as one, and what is looked into. */
export type Layout =
  /** One value: of two concurrent changes one wins as a whole. */
  | { readonly kind: "value" }
  /** A text in which people type at the same time. */
  | { readonly kind: "text" }
  /** Fields by name. Fields that make sense only together are changed as one. */
  | {
      readonly kind: "record";
      readonly fields: Readonly<Record<string, Layout>>;
      readonly together: readonly (readonly string[])[];
    }
  /** Entries by a name that a person chose. */
  | { readonly kind: "table"; readonly entry: Layout }
  /** Things in an order, each with an `id` or `name` of its own. */
  | { readonly kind: "list"; readonly item: Layout }
  /** Values without an order, each at most once. */
  | { readonly kind: "set" };

const value: Layout = { kind: "value" };
const record = (fields: Readonly<Record<string, Layout>>, together: readonly (readonly string[])[] = []): Layout => ({
  kind: "record",
  fields,
  together,
});
const list = (item: Layout): Layout => ({ kind: "list", item });
const table = (entry: Layout): Layout => ({ kind: "table", entry });

/** Steps hold steps, so their layout holds itself. */
const stepFields: Record<string, Layout> = {};
const step = record(stepFields, [
  ["type", "path", "via"],
  ["blend_m", "blend_ratio"],
  ["signal", "variable", "to", "pulse_s"],
  ["routine", "arguments"],
]);
const steps = list(step);
Object.assign(stepFields, { steps, then: steps, else: steps, late: steps });

/** A program of steps, and a vendor's text. */
const program = record({
  tools: table(value),
  frames: table(value),
  groups: table(value),
  signals: table(value),
  variables: table(value),
  parameters: table(value),
  pallets: table(value),
  routines: table(steps),
  steps,
  files: list(record({ text: { kind: "text" } })),
});

/** The layout of a cell document. Fields that are not named are single values. */
export const CELL_LAYOUT: Layout = record({
  robot: record({}, [["id", "file"]]),
  errors: record({}),
  tools: list(record({})),
  objects: list(record({})),
  frames: list(record({}, [["worldFromFrame", "attachedTo"]])),
  allowedPairs: { kind: "set" },
  sensors: list(record({}, [["kind", "from_m", "to_m", "at_m", "range_m"]])),
  people: list(record({})),
  zones: list(record({})),
  programs: list(program),
  comments: list(record({})),
});

/** One thing that is changed as one: a field, or fields that belong together. */
export interface Unit {
  /** What it is called in the shared document. */
  readonly key: string;
  readonly fields: readonly string[];
  readonly layout: Layout;
}

/** The units of a record that has these fields. */
export function unitsOf(
  layout: Extract<Layout, { readonly kind: "record" }>,
  names: Iterable<string>,
): readonly Unit[] {
  const units = new Map<string, Unit>();
  for (const name of names) {
    const together = layout.together.find(group => group.includes(name));
    const key = together ? together.join("+") : name;
    const inside = Object.hasOwn(layout.fields, name) ? layout.fields[name]! : value;
    if (!units.has(key)) units.set(key, { key, fields: together ?? [name], layout: together ? value : inside });
  }
  return [...units.values()];
}

export type Json = Readonly<Record<string, unknown>>;
export const isRecord = (thing: unknown): thing is Json =>
  typeof thing === "object" && thing !== null && !Array.isArray(thing);

/** What a thing of a list is known by. */
export const keyOf = (item: unknown): string => {
  const { id, name } = (isRecord(item) ? item : {}) as { readonly id?: unknown; readonly name?: unknown };
  return typeof id === "string" ? id : typeof name === "string" ? name : "";
};

/** Equal values, whatever the order of their keys. */
export function same(a: unknown, b: unknown): boolean {
  if (Object.is(a, b)) return true;
  if (Array.isArray(a) && Array.isArray(b))
    return a.length === b.length && a.every((each, i) => same(each, (b as unknown[])[i]));
  if (!isRecord(a) || !isRecord(b)) return false;
  const names = Object.keys(a);
  return (
    names.filter(name => a[name] !== undefined).length ===
      Object.keys(b).filter(name => b[name] !== undefined).length && names.every(name => same(a[name], b[name]))
  );
}
