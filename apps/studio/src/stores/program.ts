import {
  applyRepair, duplicateSteps, freshStepId, insertSteps, moveSteps, removeSteps, replaceStep,
  type Condition, type MoveStep, type Program, type Repair, type Speed, type Step, type Verdict,
} from "@twincell/core";
import { words } from "../words/index.ts";
import { commit, theProgram, withProgram } from "./document.ts";
import { select, selectionStore } from "./selection.ts";

/** Where new steps go: after the selected one, or at the end. */
function insertionIndex(program: Program): number {
  const { selected } = selectionStore.getState();
  const at = selected?.kind === "step" ? program.steps.findIndex(step => step.id === selected.id) : -1;
  return at < 0 ? program.steps.length : at + 1;
}
const edit = (label: string, change: (program: Program) => Program, gesture?: string): boolean =>
  commit(label, document => withProgram(document, change), gesture);

/** Adds steps, selects the last of them and says whether there was a program to add them to. */
export function addSteps(label: string, make: (program: Program) => readonly Step[], change: (program: Program) => Program = program => program, gesture?: string): boolean {
  const program = theProgram();
  if (!program) return false;
  const steps = make(program), at = insertionIndex(program);
  const last = steps.at(-1);
  if (!last || !edit(label, before => change(insertSteps(before, at, steps)), gesture)) return false;
  select({ kind: "step", id: last.id });
  return true;
}

/** Records these joint angles as the target of a move (rows N-32, T-29). Joints leave no doubt about the posture. */
export function recordPoint(path: MoveStep["path"], q_rad: ArrayLike<number>, tool: string): boolean {
  const q = Array.from(q_rad), speed: Speed = path === "ptp" ? { ratio: 0.4 } : { mps: 0.1 };
  if (!q.every(Number.isFinite)) return false;
  return addSteps(words.undo.recordPoint, program => [{
    id: freshStepId(program, "p"), type: "move", path, speed, blend_m: 0, target: tool === "flange" ? { q } : { q, tool },
  }]);
}
export const addWait = (s: number): boolean => addSteps(words.undo.addWait, program => [{ id: freshStepId(program, "w"), type: "wait", s }]);
export const addGripper = (closed: boolean): boolean => addSteps(words.undo.addGripper, program => [{ id: freshStepId(program, "g"), type: "gripper", closed }]);

export function changeStep(id: string, label: string, change: (step: Step) => Step, gesture?: string): boolean {
  return edit(label, program => {
    const before = program.steps.find(step => step.id === id);
    if (!before) return program;
    const after = change(before);
    return after === before ? program : replaceStep(program, id, after);
  }, gesture);
}
export const changeMove = (id: string, label: string, change: (step: MoveStep) => MoveStep, gesture?: string): boolean =>
  changeStep(id, label, step => (step.type === "move" ? change(step) : step), gesture);
/** Row L-42 in its first form: the point becomes where the robot stands. */
export const touchUp = (id: string, q_rad: ArrayLike<number>, tool: string): boolean => changeMove(id, words.undo.touchUp, step => ({
  ...step, target: tool === "flange" ? { q: Array.from(q_rad) } : { q: Array.from(q_rad), tool },
}));
export const renameStep = (id: string, name: string): boolean => changeStep(id, words.undo.rename, step => {
  const { name: before, ...rest } = step, wanted = name.trim();
  if (wanted === (before ?? "")) return step;
  return wanted === "" ? rest : { ...rest, name: wanted };
});

export function deleteSteps(ids: readonly string[]): boolean {
  const first = theProgram()?.steps.findIndex(step => ids.includes(step.id)) ?? -1;
  if (!edit(words.undo.deleteSteps(ids.length), program => removeSteps(program, ids))) return false;
  const left = theProgram()?.steps ?? [];
  const next = left[Math.min(Math.max(0, first), left.length - 1)];
  select(next ? { kind: "step", id: next.id } : null);
  return true;
}
export const copySteps = (ids: readonly string[]): boolean => edit(words.undo.duplicate, program => duplicateSteps(program, ids));
/** Puts the steps, in their order, before the step `before`, or at the end when it is null. */
export const placeSteps = (ids: readonly string[], before: string | null): boolean => edit(words.undo.reorder, program => {
  if (before !== null && ids.includes(before)) return program;
  const rest = program.steps.filter(step => !ids.includes(step.id));
  return moveSteps(program, ids, before === null ? rest.length : rest.findIndex(step => step.id === before));
});
export function clearProgram(): boolean {
  const done = edit(words.undo.clear, program => (program.steps.length === 0 ? program : { ...program, steps: [], groups: {} }));
  if (done) select(null);
  return done;
}
export const repairStep = (id: string, repair: Repair): boolean => edit(words.undo.repair, program => applyRepair(program, id, repair));
/** Several repairs are one undo step. */
export const repairAll = (repairs: readonly { readonly id: string; readonly repair: Repair }[]): boolean =>
  edit(words.undo.repairAll, program => repairs.reduce((so, { id, repair }) => applyRepair(so, id, repair), program));

/** The first repair of every step that has one. */
export const firstRepairs = (verdict: Verdict | null): readonly { readonly id: string; readonly repair: Repair }[] => (verdict?.steps ?? []).flatMap(step => {
  const repair = step.findings.find(finding => finding.repairs.length > 0)?.repairs[0];
  return repair ? [{ id: step.id, repair }] : [];
});

/** What a person reads for a step that has no name of its own. */
export function stepWords(step: Step, index: number): string {
  if (step.name) return step.name;
  switch (step.type) {
    case "move": return words.step.point(index + 1);
    case "wait": return words.step.wait(step.s);
    case "gripper": return step.closed ? words.step.close : words.step.open;
    case "set": return step.pulse_s === undefined ? words.step.set(step.signal, level(step.to)) : words.step.pulse(step.signal, level(step.to), step.pulse_s);
    case "wait-for": return words.step.waitFor(conditionWords(step.when));
    case "payload": return words.step.payload(step.mass_kg);
    case "message": return words.step.say(step.text);
    case "stop": return words.step.stop;
    case "comment": return step.text === "" ? words.step.comment : step.text;
    case "call": return words.step.call(step.routine);
    case "repeat": return step.times === "forever" ? words.step.forever : words.step.repeat(step.times);
    case "if": return words.step.if(conditionWords(step.when));
    case "pallet": return words.step.pallet(step.pallet);
  }
}

const level = (to: boolean | number): string => (typeof to === "number" ? String(to) : to ? words.common.on : words.common.off);
/** A condition as it stands in a sentence. */
export function conditionWords(when: Condition): string {
  if ("is" in when) return words.step.is(when.signal, level(when.is));
  return "above" in when ? words.step.above(when.signal, when.above) : words.step.below(when.signal, when.below);
}
