import type { Group, Program, Step } from "./program.ts";

/*
 * Edits of a program: each takes a program and returns another, sharing what did not change, so that undo is keeping
 * the one before. Places count from 0 and are clamped to the list; an id that does not exist changes nothing and
 * returns the very same program.
 */

/** An id no step has: `prefix` and the next number. */
export function freshStepId(program: Pick<Program, "steps">, prefix = "s"): string {
  return freshStepIds(program, 1, prefix)[0]!;
}

export function freshStepIds(program: Pick<Program, "steps">, count: number, prefix = "s"): string[] {
  let highest = 0;
  for (const step of program.steps) {
    const digits = step.id.startsWith(prefix) ? step.id.slice(prefix.length) : "";
    if (/^[0-9]{1,15}$/.test(digits)) highest = Math.max(highest, Number(digits));
  }
  return Array.from({ length: count }, (_, i) => `${prefix}${highest + 1 + i}`);
}

/** The same steps under ids the program does not have. */
export function withFreshIds(program: Pick<Program, "steps">, steps: readonly Step[], prefix = "s"): Step[] {
  const ids = freshStepIds({ steps: [...program.steps, ...steps] }, steps.length, prefix);
  return steps.map((step, i) => ({ ...step, id: ids[i]! }));
}

/** Puts steps before place `at`; a step whose id exists already gets a fresh one. */
export function insertSteps(program: Program, at: number, steps: readonly Step[]): Program {
  if (steps.length === 0) return program;
  const taken = new Set(program.steps.map(step => step.id));
  let added: readonly Step[] = steps;
  if (steps.some(step => taken.has(step.id)) || new Set(steps.map(step => step.id)).size < steps.length) added = withFreshIds(program, steps);
  const place = clampPlace(at, program.steps.length);
  return { ...program, steps: [...program.steps.slice(0, place), ...added, ...program.steps.slice(place)] };
}

export const appendStep = (program: Program, step: Step): Program => insertSteps(program, program.steps.length, [step]);

/** Puts steps before the step of that id. */
export function insertBefore(program: Program, id: string, steps: readonly Step[]): Program {
  const at = indexOfStep(program, id);
  return at < 0 ? program : insertSteps(program, at, steps);
}

export function removeSteps(program: Program, ids: readonly string[]): Program {
  const gone = new Set(ids), steps = program.steps.filter(step => !gone.has(step.id));
  return steps.length === program.steps.length ? program : { ...program, steps };
}

/** Moves steps, in their order, so that the first of them stands at place `to` of the list without them. */
export function moveSteps(program: Program, ids: readonly string[], to: number): Program {
  const moved = new Set(ids), taken = program.steps.filter(step => moved.has(step.id));
  if (taken.length === 0) return program;
  const rest = program.steps.filter(step => !moved.has(step.id)), place = clampPlace(to, rest.length);
  const steps = [...rest.slice(0, place), ...taken, ...rest.slice(place)];
  return steps.every((step, i) => step === program.steps[i]) ? program : { ...program, steps };
}

/** Puts `step` where the step of that id is. The new step may have another id, unless that one is taken. */
export function replaceStep(program: Program, id: string, step: Step): Program {
  const at = indexOfStep(program, id);
  if (at < 0) return program;
  const id2 = step.id !== id && indexOfStep(program, step.id) >= 0 ? id : step.id;
  return { ...program, steps: program.steps.with(at, { ...step, id: id2 }) };
}

/** Copies of steps, with fresh ids, behind the last of them. */
export function duplicateSteps(program: Program, ids: readonly string[]): Program {
  const wanted = new Set(ids), last = program.steps.findLastIndex(step => wanted.has(step.id));
  if (last < 0) return program;
  return insertSteps(program, last + 1, withFreshIds(program, program.steps.filter(step => wanted.has(step.id))));
}

/** Puts steps into a group, or takes them out of theirs when `group` is undefined. Groups nobody is in disappear. */
export function regroupSteps(program: Program, ids: readonly string[], group: string | undefined, details?: Group): Program {
  const wanted = new Set(ids);
  const steps = program.steps.map(step => {
    const { group: before, ...rest } = step;
    if (!wanted.has(step.id) || before === group) return step;
    return group === undefined ? rest : { ...rest, group };
  });
  const groups = group === undefined || (details === undefined && Object.hasOwn(program.groups, group))
    ? program.groups : Object.fromEntries([...Object.entries(program.groups), [group, details ?? { name: group }]]);
  return withoutEmptyGroups({ ...program, steps, groups });
}

function withoutEmptyGroups(program: Program): Program {
  const used = new Set(program.steps.map(step => step.group));
  const kept = Object.entries(program.groups).filter(([id]) => used.has(id));
  return kept.length === Object.keys(program.groups).length ? program : { ...program, groups: Object.fromEntries(kept) };
}

/** Applies a repair of the checker to the step it was offered for. */
export function applyRepair(program: Program, id: string, repair: { readonly replace?: Step; readonly insertBefore?: readonly Step[] }): Program {
  const replaced = repair.replace === undefined ? program : replaceStep(program, id, repair.replace);
  return repair.insertBefore === undefined ? replaced : insertBefore(replaced, repair.replace?.id ?? id, repair.insertBefore);
}

export const indexOfStep = (program: Pick<Program, "steps">, id: string): number => program.steps.findIndex(step => step.id === id);

const clampPlace = (at: number, length: number): number => (at >= length ? length : at > 0 ? Math.floor(at) : 0);
