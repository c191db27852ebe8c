import { emptyProgram, versionOf, withLists, type Program, type Step } from "@twincell/core";
import { followObjects } from "../attach.ts";
import { isTextProgram, type CellDocument, type CellProgram } from "../document.ts";

type Mutable<T> = { -readonly [K in keyof T]: T[K] };
const lists = new WeakMap<object, unknown>();
const programs = new WeakMap<CellProgram, CellProgram>();

/**
 * A merged cell in which every id and name is there once and what is selected exists. Two people may have added things
 * of the same name at the same time: the second has a number. The very same cell when there is nothing to mend; the
 * same answer for every editor.
 */
export function mendMerged(merged: CellDocument): CellDocument {
  const cell: Mutable<CellDocument> = { ...merged };
  cell.tools = unique(merged.tools, "name", " ");
  cell.objects = unique(merged.objects, "id", "-");
  cell.frames = unique(merged.frames, "name", " ");
  if (merged.sensors) cell.sensors = unique(merged.sensors, "id", "-");
  if (merged.people) cell.people = unique(merged.people, "id", "-");
  if (merged.zones) cell.zones = unique(merged.zones, "id", "-");
  if (merged.comments) cell.comments = unique(merged.comments, "id", "-");
  const named = unique(merged.programs, "name", " ");
  const mended = named.map(mendProgram);
  cell.programs = mended.every((each, i) => each === merged.programs[i]) ? merged.programs : mended;
  if (cell.programs.length === 0) cell.programs = [emptyProgram(merged.robot.id)];
  if (cell.tool !== "flange" && !cell.tools.some(({ name }) => name === cell.tool)) cell.tool = "flange";
  if (!cell.programs.some(({ name }) => name === cell.program)) cell.program = cell.programs[0]!.name;
  const keys = Object.keys(cell) as (keyof CellDocument)[];
  return followObjects(keys.every(key => cell[key] === merged[key]) ? merged : cell);
}

/** The same list, the same answer: what did not change is not looked at again. */
function unique<T extends object>(list: readonly T[], key: keyof T & string, between: string): readonly T[] {
  const known = lists.get(list);
  if (known !== undefined) return known as readonly T[];
  const all = new Set(list.map(item => item[key] as string));
  const seen = new Set<string>();
  const made = list.map(item => {
    const wanted = item[key] as string;
    if (!seen.has(wanted)) {
      seen.add(wanted);
      return item;
    }
    const free = freeName(wanted, between, name => all.has(name) || seen.has(name));
    seen.add(free);
    return { ...item, [key]: free };
  });
  const answer = made.every((item, i) => item === list[i]) ? list : made;
  lists.set(list, answer);
  return answer;
}

function freeName(wanted: string, between: string, taken: (name: string) => boolean): string {
  for (let i = 2; ; i++) if (!taken(`${wanted}${between}${i}`)) return `${wanted}${between}${i}`;
}

/** Ids of steps once, and the version that the steps need. */
function mendProgram(program: CellProgram): CellProgram {
  if (isTextProgram(program)) return program;
  const known = programs.get(program);
  if (known !== undefined) return known;
  const seen = new Set<string>();
  const rename = (steps: readonly Step[]): readonly Step[] => {
    const made = steps.map(step => {
      const id = seen.has(step.id) ? freeName(step.id, "-", name => seen.has(name)) : step.id;
      seen.add(id);
      return withLists(id === step.id ? step : { ...step, id }, rename);
    });
    return made.every((step, i) => step === steps[i]) ? steps : made;
  };
  const steps = rename(program.steps);
  const routines = Object.entries(program.routines).map(([name, list]) => [name, rename(list)] as const);
  const sameRoutines = routines.every(([name, list]) => list === program.routines[name]);
  const together: Program = {
    ...program,
    steps,
    routines: sameRoutines ? program.routines : Object.fromEntries(routines),
  };
  const version = versionOf(together);
  const mended =
    steps === program.steps && sameRoutines && version === program.version ? program : { ...together, version };
  programs.set(program, mended);
  return mended;
}
