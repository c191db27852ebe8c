import { isTextProgram, type CellDocument } from "./document.ts";

/** One difference between two cells: where, and what it was and is. */
export interface CellDifference {
  readonly kind: "added" | "removed" | "changed";
  /** What a person would call the place: “object Carton, position”. */
  readonly where: string;
  readonly before?: string;
  readonly after?: string;
}

/**
 * What differs between two cells, in the order of the document: robot, tools, objects, frames, programs with their
 * steps, the rest. Things are told apart by id or name, not by place in a list; steps that only changed their order are
 * one line. Lengths are written in mm and angles of joints in degrees, with the difference of every position. Equal
 * cells give an empty list.
 */
export function diffCells(before: CellDocument, after: CellDocument): readonly CellDifference[] {
  const { robot: robotA, tools: toolsA, objects: objectsA, frames: framesA, programs: programsA, ...restA } = before;
  const { robot: robotB, tools: toolsB, objects: objectsB, frames: framesB, programs: programsB, ...restB } = after;
  return [
    ...fields("robot", robotA, robotB),
    ...lists("tool", toolsA, toolsB, byName, byName),
    ...lists("object", objectsA, objectsB, ({ id }) => id, byName),
    ...lists("frame", framesA, framesB, byName, byName),
    ...programs(programsA, programsB),
    ...fields("cell", restA, restB),
  ];
}

/** The differences as text, one a line: `+` added, `−` removed, `~` changed. */
export const sayDifferences = (differences: readonly CellDifference[]): readonly string[] =>
  differences.map(({ kind, where, before, after }) => {
    const sign = { added: "+", removed: "−", changed: "~" }[kind];
    const values = before !== undefined && after !== undefined ? `: ${before} → ${after}` : "";
    return `${sign} ${where}${values}`;
  });

const byName = ({ name }: { readonly name: string }): string => name;

function lists<T extends object>(
  what: string,
  before: readonly T[],
  after: readonly T[],
  key: (item: T) => string,
  name: (item: T) => string,
): CellDifference[] {
  const was = new Map(before.map(item => [key(item), item]));
  const is = new Map(after.map(item => [key(item), item]));
  return [
    ...before
      .filter(item => !is.has(key(item)))
      .map((item): CellDifference => ({ kind: "removed", where: `${what} ${name(item)}` })),
    ...after.flatMap((item): readonly CellDifference[] => {
      const old = was.get(key(item));
      return old === undefined
        ? [{ kind: "added", where: `${what} ${name(item)}` }]
        : fields(`${what} ${name(item)}`, old, item);
    }),
  ];
}

function programs(before: CellDocument["programs"], after: CellDocument["programs"]): CellDifference[] {
  const differences: CellDifference[] = [];
  for (const old of before)
    if (!after.some(({ name }) => name === old.name))
      differences.push({ kind: "removed", where: `program ${old.name}` });
  for (const program of after) {
    const where = `program ${program.name}`;
    const old = before.find(({ name }) => name === program.name);
    if (old === undefined) differences.push({ kind: "added", where });
    else if (isTextProgram(program) || isTextProgram(old)) differences.push(...fields(where, old, program));
    else {
      const { steps: stepsA, ...restA } = old;
      const { steps: stepsB, ...restB } = program;
      const nameOf = (step: (typeof stepsB)[number]): string =>
        "name" in step && step.name ? `“${step.name}” (${step.id})` : step.id;
      differences.push(...lists(`${where}, step`, stepsA, stepsB, ({ id }) => id, nameOf));
      const common = (all: typeof stepsA, others: typeof stepsA): string =>
        all
          .filter(({ id }) => others.some(other => other.id === id))
          .map(({ id }) => id)
          .join(" ");
      if (common(stepsA, stepsB) !== common(stepsB, stepsA))
        differences.push({ kind: "changed", where: `${where}, order of its steps` });
      differences.push(...fields(where, restA, restB));
    }
  }
  return differences;
}

/** Differences of two values field by field, as deep as they go; lists of numbers are one value. */
function fields(where: string, before: unknown, after: unknown, field = ""): CellDifference[] {
  if (same(before, after)) return [];
  if (isRecord(before) && isRecord(after)) {
    const names = [...new Set([...Object.keys(before), ...Object.keys(after)])];
    return names.flatMap(name => fields(`${where}, ${label(name)}`, before[name], after[name], name));
  }
  if (before === undefined) return [{ kind: "added", where: `${where} ${show(after, field)}`.trimEnd() }];
  if (after === undefined) return [{ kind: "removed", where: `${where} ${show(before, field)}`.trimEnd() }];
  return [
    { kind: "changed", where, before: show(before, field), after: show(after, field) + moved(before, after, field) },
  ];
}

/** Names of the document as a person says them; the unit goes with the value. */
const label = (name: string): string =>
  ({ worldFromObject: "pose", worldFromFrame: "pose", worldFromBase: "base", flangeFromTcp: "TCP" })[name] ??
  name.replace(/_(m|kg|s|rad|mps)$/, "");

const MAX_TEXT = 60;
function show(value: unknown, field: string): string {
  if (isNumbers(value) && (field === "position" || field.endsWith("_m")))
    return `${value.map(each => millimetres(each)).join(", ")} mm`;
  if (isNumbers(value) && field === "q") return `${value.map(each => rounded((each * 180) / Math.PI)).join(", ")}°`;
  if (typeof value === "number" && field.endsWith("_m")) return `${millimetres(value)} mm`;
  if (typeof value === "number" && field.endsWith("_kg")) return `${rounded(value)} kg`;
  if (typeof value === "number" && field === "mps") return `${millimetres(value)} mm/s`;
  if (typeof value === "string" && value.length <= MAX_TEXT) return value;
  if (typeof value === "string") return `(text of ${value.length} characters)`;
  const text = JSON.stringify(value) ?? "";
  return text.length <= MAX_TEXT ? text : `(${Array.isArray(value) ? `${value.length} entries` : "data"})`;
}
/** How far a position moved. */
function moved(before: unknown, after: unknown, field: string): string {
  if (field !== "position" || !isNumbers(before) || !isNumbers(after)) return "";
  return ` (moved by ${millimetres(Math.hypot(...after.map((value, i) => value - (before[i] ?? 0))))} mm)`;
}
const rounded = (value: number): string => String(Math.round(value * 1000) / 1000 + 0);
const millimetres = (value_m: number): string => rounded(value_m * 1000);
const isNumbers = (value: unknown): value is readonly number[] =>
  Array.isArray(value) && value.length > 0 && value.every(each => typeof each === "number");
const isRecord = (value: unknown): value is Readonly<Record<string, unknown>> =>
  typeof value === "object" && value !== null && !Array.isArray(value);

/** Equal values, whatever the order of their keys; a field left out is the same as one that is undefined. */
function same(a: unknown, b: unknown): boolean {
  if (Object.is(a, b) || a === b) return true;
  if (Array.isArray(a) && Array.isArray(b)) return a.length === b.length && a.every((each, i) => same(each, b[i]));
  if (!isRecord(a) || !isRecord(b)) return false;
  return [...new Set([...Object.keys(a), ...Object.keys(b)])].every(name => same(a[name], b[name]));
}
