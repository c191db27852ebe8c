import type { Group, Program, RepeatStep, SignalLine, Step } from "./program.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { settled } from "./settle.ts";
import { everyIn, everyStep, listsOf, stepById, withLists } from "./walk.ts";

/*
 * Edits of a program: each takes a program and returns another, sharing what did not change, so that undo is keeping
 * the one before. Steps are found by id wherever they are, inside blocks and routines as well. Places count from 0 and
 * are clamped to the list; an id that does not exist changes nothing and returns the very same program.
 */

type Tree = Pick<Program, "steps"> & Partial<Pick<Program, "routines">>;

/** Which list of a program: the main one, that of a block (the "else" of an if when said so), or a routine. */
export type ListPlace =
  | { readonly block: string; readonly side?: "then" | "else" }
  | { readonly routine: string }
  | "main";

/** An id no step has: `prefix` and the next number. */
export function freshStepId(program: Tree, prefix = "s"): string {
  return freshStepIds(program, 1, prefix)[0]!;
}

export function freshStepIds(program: Tree, count: number, prefix = "s"): string[] {
  let highest = 0;
  for (const step of everyStep({ steps: program.steps, routines: program.routines ?? {} })) {
    const digits = step.id.startsWith(prefix) ? step.id.slice(prefix.length) : "";
    if (/^[0-9]{1,15}$/.test(digits)) highest = Math.max(highest, Number(digits));
  }
  return Array.from({ length: count }, (_, i) => `${prefix}${highest + 1 + i}`);
}

/** Ids of groups the program does not have: `prefix` and the next numbers. */
export function freshGroupIds({ groups }: Pick<Program, "groups">, count: number, prefix: string): string[] {
  let highest = 0;
  for (const id of Object.keys(groups)) {
    const digits = id.startsWith(prefix) ? id.slice(prefix.length) : "";
    if (/^[0-9]{1,15}$/.test(digits)) highest = Math.max(highest, Number(digits));
  }
  return Array.from({ length: count }, (_, i) => `${prefix}${highest + 1 + i}`);
}

/** The same steps under ids the program does not have, also inside blocks. */
export function withFreshIds(program: Tree, steps: readonly Step[], prefix = "s"): Step[] {
  const fresh = freshStepIds({ ...program, steps: [...program.steps, ...steps] }, [...everyIn(steps)].length, prefix);
  let next = 0;
  const renamed = (step: Step): Step => {
    const id = fresh[next++]!;
    return withLists({ ...step, id }, list => list.map(renamed));
  };
  return steps.map(renamed);
}

/** Puts steps before place `at` of the main list; when one of their ids exists already, they all get fresh ones. */
export const insertSteps = (program: Program, at: number, steps: readonly Step[]): Program =>
  insertInto(program, "main", at, steps);

/** The same for any list. */
export function insertInto(program: Program, where: ListPlace, at: number, steps: readonly Step[]): Program {
  if (steps.length === 0) return program;
  const added = freed(program, steps);
  return changed(
    program,
    inList(program, where, list => {
      const place = clampPlace(at, list.length);
      return [...list.slice(0, place), ...added, ...list.slice(place)];
    }),
  );
}

export const appendStep = (program: Program, step: Step): Program => insertSteps(program, program.steps.length, [step]);

/** Puts steps before the step of that id. */
export const insertBefore = (program: Program, id: string, steps: readonly Step[]): Program =>
  beside(program, id, 0, steps);
/** Puts steps behind the step of that id. */
export const insertAfter = (program: Program, id: string, steps: readonly Step[]): Program =>
  beside(program, id, 1, steps);

function beside(program: Program, id: string, offset: 0 | 1, steps: readonly Step[]): Program {
  if (steps.length === 0) return program;
  const added = freed(program, steps);
  return changed(
    program,
    everyList(program, list => {
      const at = list.findIndex(step => step.id === id);
      return at < 0 ? list : [...list.slice(0, at + offset), ...added, ...list.slice(at + offset)];
    }),
  );
}

/** Takes steps out, with what is inside them. */
export function removeSteps(program: Program, ids: readonly string[]): Program {
  const gone = new Set(ids);
  return everyList(program, list =>
    list.some(step => gone.has(step.id)) ? list.filter(step => !gone.has(step.id)) : list,
  );
}

/** Moves steps, in their order, so that the first of them stands at place `to` of the main list without them. */
export const moveSteps = (program: Program, ids: readonly string[], to: number): Program =>
  moveInto(program, ids, "main", to);

/** The same for any list. A block never goes into itself: that changes nothing. */
export function moveInto(program: Program, ids: readonly string[], where: ListPlace, to: number): Program {
  const moved = new Set(ids);
  const taken: Step[] = [];
  // A step inside a block that moves goes with it.
  const take = (list: readonly Step[]): void => {
    for (const step of list)
      if (moved.has(step.id)) taken.push(step);
      else listsOf(step).forEach(take);
  };
  take(program.steps);
  Object.values(program.routines).forEach(take);
  if (taken.length === 0) return program;
  const rest = removeSteps(program, ids);
  const after = inList(rest, where, list => {
    const place = clampPlace(to, list.length);
    return [...list.slice(0, place), ...taken, ...list.slice(place)];
  });
  return after === rest || sameOrder(after, program) ? program : changed(program, after);
}

/** Moves steps to stand before the step of that id. */
export function moveBefore(program: Program, ids: readonly string[], id: string): Program {
  const place = placeOf(removeSteps(program, ids), id);
  return place === undefined ? program : moveInto(program, ids, place.where, place.at);
}

/** Puts `step` where the step of that id is. The new step may have another id, unless that one is taken. */
export function replaceStep(program: Program, id: string, step: Step): Program {
  const id2 = step.id !== id && stepById(program, step.id) !== undefined ? id : step.id;
  return changed(
    program,
    everyList(program, list => {
      const at = list.findIndex(each => each.id === id);
      return at < 0 ? list : list.with(at, { ...step, id: id2 });
    }),
  );
}

/** Copies of steps, with fresh ids, behind the last of them; in each list for itself. */
export function duplicateSteps(program: Program, ids: readonly string[]): Program {
  const wanted = new Set(ids);
  let so = program;
  const copy = (list: readonly Step[]): readonly Step[] => {
    const last = list.findLastIndex(step => wanted.has(step.id));
    if (last < 0) return list;
    const copies = withFreshIds(
      so,
      list.filter(step => wanted.has(step.id)),
    );
    so = { ...so, steps: [...so.steps, ...copies] };
    return [...list.slice(0, last + 1), ...copies, ...list.slice(last + 1)];
  };
  return everyList(program, copy);
}

/** Puts steps into a loop, in their order, where the first of them was. */
export function wrapInRepeat(program: Program, ids: readonly string[], times: RepeatStep["times"]): Program {
  const wanted = new Set(ids);
  const begin = Array.from(everyStep(program)).find(step => wanted.has(step.id));
  const first = begin && placeOf(program, begin.id);
  if (first === undefined) return program;
  const loop: RepeatStep = { id: freshStepId(program, "r"), type: "repeat", times, steps: [] };
  const held = insertInto(program, first.where, first.at, [loop]);
  return moveInto(held, ids, { block: loop.id }, 0);
}

/** Puts steps into a group, or takes them out of theirs when `group` is undefined. Groups nobody is in disappear. */
export function regroupSteps(
  program: Program,
  ids: readonly string[],
  group: string | undefined,
  details?: Group,
): Program {
  const wanted = new Set(ids);
  const regrouped = everyList(program, list =>
    list.some(step => wanted.has(step.id) && step.group !== group)
      ? list.map(step => {
          const { group: before, ...rest } = step;
          if (!wanted.has(step.id) || before === group) return step;
          return group === undefined ? rest : { ...rest, group };
        })
      : list,
  );
  const groups =
    group === undefined || (details === undefined && Object.hasOwn(program.groups, group))
      ? program.groups
      : Object.fromEntries([...Object.entries(program.groups), [group, details ?? { name: group }]]);
  return withoutEmptyGroups({ ...regrouped, groups });
}

function withoutEmptyGroups(program: Program): Program {
  const used = new Set(Array.from(everyStep(program), step => step.group));
  const kept = Object.entries(program.groups).filter(([id]) => used.has(id));
  return kept.length === Object.keys(program.groups).length
    ? program
    : { ...program, groups: Object.fromEntries(kept) };
}

/** One change of a program that belongs to a step: the step itself, what comes before it, and what changes with it. */
export interface ProgramChange {
  readonly replace?: Step;
  /** Steps to put before the step, when the way out is an extra point. */
  readonly insertBefore?: readonly Step[];
  /** Other steps as they would be, found by their ids. */
  readonly alsoReplace?: readonly Step[];
  /** A frame of the program moved in the world by this much [m], with everything taught in it. */
  readonly moveFrame?: { readonly frame: string; readonly by_m: Vector3 };
}

/** Applies a repair of the checker to the step it was offered for. */
export function applyRepair(program: Program, id: string, repair: ProgramChange): Program {
  const { replace, insertBefore: before = [], alsoReplace = [], moveFrame } = repair;
  let so = replace === undefined ? program : replaceStep(program, id, replace);
  if (before.length > 0) so = insertBefore(so, replace?.id ?? id, before);
  for (const step of alsoReplace) so = replaceStep(so, step.id, step);
  return moveFrame === undefined ? so : moveFrameBy(so, moveFrame.frame, moveFrame.by_m);
}

/** The program with one of its frames moved in the world [m]; a frame it does not have changes nothing. */
export function moveFrameBy(program: Program, frame: string, by_m: Vector3): Program {
  if (!Object.hasOwn(program.frames, frame)) return program;
  const { position, quaternion } = program.frames[frame]!;
  const moved: Vector3 = [position[0] + by_m[0], position[1] + by_m[1], position[2] + by_m[2]];
  return { ...program, frames: { ...program.frames, [frame]: { position: moved, quaternion } } };
}

/** Gives a signal its line; one of that name is replaced. */
export const withSignal = (program: Program, name: string, line: SignalLine): Program => ({
  ...program,
  signals: Object.fromEntries([...Object.entries(program.signals), [name, line]]),
});

/** Place of a step of the main list; -1 for a step inside a block or a routine. */
export const indexOfStep = (program: Pick<Program, "steps">, id: string): number =>
  program.steps.findIndex(step => step.id === id);

/** In which list a step stands, and where. */
export function placeOf(
  program: Pick<Program, "steps" | "routines">,
  id: string,
): { readonly where: ListPlace; readonly at: number } | undefined {
  const search = (
    list: readonly Step[],
    where: ListPlace,
  ): { readonly where: ListPlace; readonly at: number } | undefined => {
    const at = list.findIndex(step => step.id === id);
    if (at >= 0) return { where, at };
    for (const step of list) {
      const sides = step.type === "if" ? (["then", "else"] as const) : [undefined];
      for (const [i, inner] of listsOf(step).entries()) {
        const side = sides[i];
        const found = search(inner, side === undefined ? { block: step.id } : { block: step.id, side });
        if (found !== undefined) return found;
      }
    }
    return undefined;
  };
  let found = search(program.steps, "main");
  for (const [routine, list] of Object.entries(program.routines)) found ??= search(list, { routine });
  return found;
}

/** Every list of the program put through `change`, the innermost first; the very same program when none changed. */
function everyList(program: Program, change: (list: readonly Step[]) => readonly Step[]): Program {
  const inside = (list: readonly Step[]): readonly Step[] => {
    const changed = list.map(step => withLists(step, inside));
    return change(changed.every((step, i) => step === list[i]) ? list : changed);
  };
  const steps = inside(program.steps);
  const routines = Object.entries(program.routines).map(([name, list]) => [name, inside(list)] as const);
  const same = routines.every(([name, list]) => list === program.routines[name]);
  if (same && steps === program.steps) return program;
  return { ...program, steps, routines: same ? program.routines : Object.fromEntries(routines) };
}

function inList(program: Program, where: ListPlace, change: (list: readonly Step[]) => readonly Step[]): Program {
  if (where === "main") return { ...program, steps: change(program.steps) };
  if ("routine" in where) {
    if (!Object.hasOwn(program.routines, where.routine)) return program;
    return {
      ...program,
      routines: Object.fromEntries(
        Object.entries(program.routines).map(([name, list]) => [name, name === where.routine ? change(list) : list]),
      ),
    };
  }
  return everyList(program, list => {
    const at = list.findIndex(step => step.id === where.block);
    const step = list[at];
    if (step === undefined) return list;
    if (step.type === "if")
      return list.with(
        at,
        where.side === "else" ? { ...step, else: change(step.else ?? []) } : { ...step, then: change(step.then) },
      );
    if (step.type === "wait-for") return list.with(at, { ...step, late: change(step.late ?? []) });
    return step.type === "repeat" || step.type === "while" || step.type === "pallet"
      ? list.with(at, { ...step, steps: change(step.steps) })
      : list;
  });
}

function freed(program: Program, steps: readonly Step[]): readonly Step[] {
  const taken = new Set(Array.from(everyStep(program), step => step.id));
  const ids = Array.from(everyIn(steps), step => step.id);
  return ids.some(id => taken.has(id)) || new Set(ids).size < ids.length ? withFreshIds(program, steps) : steps;
}

/** Places of pallets mean something only inside their pallet's step. */
const changed = (before: Program, after: Program): Program => (after === before ? before : settled(after));

const sameOrder = (a: Program, b: Program): boolean =>
  sameList(a.steps, b.steps) &&
  Object.entries(a.routines).every(([name, list]) => sameList(list, b.routines[name] ?? []));
const sameList = (a: readonly Step[], b: readonly Step[]): boolean =>
  a.length === b.length &&
  a.every((step, i) => {
    const other = b[i]!;
    const inner = listsOf(other);
    return step.id === other.id && listsOf(step).every((list, k) => sameList(list, inner[k] ?? []));
  });

const clampPlace = (at: number, length: number): number => (at >= length ? length : at > 0 ? Math.floor(at) : 0);
