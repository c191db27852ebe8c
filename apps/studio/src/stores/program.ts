import type { MoveStep, Program, Speed, Step } from "@twincell/core";
import { words } from "../words/index.ts";
import { cellStore } from "./cell.ts";
import { commit, programOf, withProgram } from "./document.ts";
import { select, selectionStore } from "./selection.ts";

/** A step id that the program does not have yet: "p7", … */
export function freshId(program: Program, prefix: string): string {
  const taken = new Set(program.steps.map(step => step.id));
  let n = program.steps.length + 1;
  while (taken.has(`${prefix}${n}`)) n++;
  return `${prefix}${n}`;
}
export function freshIds(program: Program, prefix: string, count: number): readonly string[] {
  const taken = new Set(program.steps.map(step => step.id)), ids: string[] = [];
  for (let n = program.steps.length + 1; ids.length < count; n++) if (!taken.has(`${prefix}${n}`)) ids.push(`${prefix}${n}`);
  return ids;
}

/** Where new steps go: after the selected one, or at the end. */
function insertionIndex(program: Program): number {
  const { selected } = selectionStore.getState();
  const at = selected?.kind === "step" ? program.steps.findIndex(step => step.id === selected.id) : -1;
  return at < 0 ? program.steps.length : at + 1;
}

/** Adds steps made for the present program, selects the last and returns whether there was a program. */
export function addSteps(label: string, make: (program: Program) => readonly Step[], change: (program: Program) => Program = program => program): boolean {
  const program = programOf(cellStore.getState().document);
  if (!program) return false;
  const steps = make(program);
  if (steps.length === 0) return false;
  const at = insertionIndex(program);
  const done = commit(label, document => withProgram(document, before => change({ ...before, steps: before.steps.toSpliced(at, 0, ...steps) })));
  if (done) select({ kind: "step", id: steps.at(-1)!.id });
  return done;
}

/** Records these joint angles as the target of a move (rows N-32, T-29). Joints leave no doubt about the posture. */
export function recordPoint(path: MoveStep["path"], q_rad: ArrayLike<number>, tool: string, speed: Speed = path === "ptp" ? { ratio: 0.4 } : { mps: 0.1 }): boolean {
  const q = Array.from(q_rad);
  if (!q.every(Number.isFinite)) return false;
  return addSteps(words.undo.recordPoint, program => [{
    id: freshId(program, "p"), type: "move", path, speed, blend_m: 0, target: tool === "flange" ? { q } : { q, tool },
  }]);
}
export const addWait = (s: number): boolean => addSteps(words.undo.addWait, program => [{ id: freshId(program, "w"), type: "wait", s }]);
export const addGripper = (closed: boolean): boolean => addSteps(words.undo.addGripper, program => [{ id: freshId(program, "g"), type: "gripper", closed }]);

export function changeStep(id: string, label: string, change: (step: Step) => Step, merge?: { readonly key: string; readonly at_ms: number }): boolean {
  return commit(label, document => withProgram(document, program => {
    const steps = program.steps.map(step => (step.id === id ? change(step) : step));
    return steps.every((step, i) => step === program.steps[i]) ? program : { ...program, steps };
  }), merge);
}
export const renameStep = (id: string, name: string): boolean => changeStep(id, words.undo.rename, step => {
  const { name: _old, ...rest } = step;
  return name.trim() === "" ? rest : { ...rest, name: name.trim() };
});

export function deleteSteps(ids: ReadonlySet<string>): boolean {
  const program = programOf(cellStore.getState().document);
  const first = program?.steps.findIndex(step => ids.has(step.id)) ?? -1;
  const done = commit(words.undo.deleteSteps(ids.size), document => withProgram(document, before => withoutUnusedGroups({ ...before, steps: before.steps.filter(step => !ids.has(step.id)) })));
  if (done && program) {
    const left = programOf(cellStore.getState().document)?.steps ?? [];
    const next = left[Math.min(first, left.length - 1)];
    select(next ? { kind: "step", id: next.id } : null);
  }
  return done;
}
export function duplicateSteps(ids: ReadonlySet<string>): boolean {
  const program = programOf(cellStore.getState().document);
  if (!program) return false;
  const copies = program.steps.filter(step => ids.has(step.id));
  const fresh = freshIds(program, "p", copies.length);
  const last = program.steps.findLastIndex(step => ids.has(step.id));
  return commit(words.undo.duplicate, document => withProgram(document, before => ({
    ...before, steps: before.steps.toSpliced(last + 1, 0, ...copies.map((step, i) => ({ ...step, id: fresh[i]! }))),
  })));
}

/** Puts the steps, in their order, before the step `before`, or at the end when it is null. */
export function moveSteps(ids: ReadonlySet<string>, before: string | null): boolean {
  return commit(words.undo.reorder, document => withProgram(document, program => {
    if (before !== null && ids.has(before)) return program;
    const moving = program.steps.filter(step => ids.has(step.id)), rest = program.steps.filter(step => !ids.has(step.id));
    const at = before === null ? rest.length : rest.findIndex(step => step.id === before);
    const steps = rest.toSpliced(at < 0 ? rest.length : at, 0, ...moving);
    return steps.every((step, i) => step === program.steps[i]) ? program : { ...program, steps };
  }));
}
export const clearProgram = (): boolean => {
  const done = commit(words.undo.clear, document => withProgram(document, program => (program.steps.length === 0 ? program : { ...program, steps: [], groups: {} })));
  if (done) select(null);
  return done;
};

function withoutUnusedGroups(program: Program): Program {
  const used = new Set(program.steps.map(step => step.group));
  return { ...program, groups: Object.fromEntries(Object.entries(program.groups).filter(([id]) => used.has(id))) };
}

/** What a person reads for a step that has no name of its own. */
export function stepWords(step: Step, index: number): string {
  if (step.name) return step.name;
  switch (step.type) {
    case "move": return words.step.point(index + 1);
    case "wait": return words.step.wait(step.s);
    case "gripper": return step.closed ? words.step.close : words.step.open;
  }
}
