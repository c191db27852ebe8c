import {
  applyRepair,
  callableFrom,
  duplicateSteps,
  everyStep,
  freshStepId,
  insertAfter,
  insertInto,
  insertSteps,
  isBlock,
  moveBefore,
  moveInto,
  moveSteps,
  nothingOf,
  removeSteps,
  replaceStep,
  routineOf,
  stepById,
  withSignal,
  wrapInRepeat,
  predicateText,
  printExpression,
  type ListPlace,
  type MoveStep,
  type Predicate,
  type Program,
  type Repair,
  type SignalLine,
  type Variable,
  type Speed,
  type Step,
  type Target,
  type Verdict,
} from "@twincell/core";
import type { CellDocument } from "@twincell/project";
import { words } from "../messages/index.ts";
import { commit, theProgram, withProgram } from "./document.ts";
import { select, selectionStore } from "./selection.ts";

/** A step wherever it is, with its number in the order in which the program is written, from 0. */
export function findStep(program: Program, id: string): { readonly step: Step; readonly index: number } | undefined {
  let index = 0;
  for (const step of everyStep(program)) {
    if (step.id === id) return { step, index };
    index++;
  }
  return undefined;
}

/** Where new steps go: after the selected one, into the selected block or routine, or at the end. */
export function insertSelected(program: Program, steps: readonly Step[]): Program {
  const { selected } = selectionStore.getState();
  if (selected?.kind === "routine" && Object.hasOwn(program.routines, selected.name))
    return insertInto(program, { routine: selected.name }, Number.POSITIVE_INFINITY, steps);
  const found = selected?.kind === "step" ? findStep(program, selected.id)?.step : undefined;
  if (found === undefined) return insertSteps(program, program.steps.length, steps);
  return isBlock(found) || (found.type === "wait-for" && found.late !== undefined)
    ? insertInto(program, { block: found.id }, Number.POSITIVE_INFINITY, steps)
    : insertAfter(program, found.id, steps);
}
const edit = (label: string, change: (program: Program) => Program, gesture?: string): boolean =>
  commit(label, document => withProgram(document, change), gesture);

/**
 * Adds steps, selects the last of them and says whether there was a program to add them to. `settle` sees the cell with
 * the steps in it, in the same undo step.
 */
export function addSteps(
  label: string,
  make: (program: Program) => readonly Step[],
  change: (program: Program) => Program = program => program,
  gesture?: string,
  settle: (document: CellDocument, steps: readonly Step[]) => CellDocument = document => document,
): boolean {
  const program = theProgram();
  if (!program) return false;
  const steps = make(program);
  const last = steps.at(-1);
  const add = (document: CellDocument): CellDocument =>
    settle(
      withProgram(document, before => change(insertSelected(before, steps))),
      steps,
    );
  if (!last || !commit(label, add, gesture)) return false;
  select({ kind: "step", id: last.id });
  return true;
}

/**
 * Records these joint angles as the target of a move (rows N-32, T-29). Joints leave no doubt about the posture.
 *
 * @param place  what the target counts from instead, where it is of a pallet's places.
 */
export function recordPoint(
  path: MoveStep["path"],
  q_rad: ArrayLike<number>,
  tool: string,
  place: (target: Target) => Target = target => target,
): boolean {
  const q = Array.from(q_rad);
  const speed: Speed = path === "ptp" ? { ratio: 0.4 } : { mps: 0.1 };
  if (!q.every(Number.isFinite)) return false;
  return addSteps(words.undo.recordPoint, program => [
    {
      id: freshStepId(program, "p"),
      type: "move",
      path,
      speed,
      blend_m: 0,
      target: place(tool === "flange" ? { q } : { q, tool }),
    },
  ]);
}
/** Records an arc through one posture to another. */
export function recordArcTo(via_rad: ArrayLike<number>, q_rad: ArrayLike<number>, tool: string): boolean {
  const target = (angles: ArrayLike<number>): MoveStep["target"] =>
    tool === "flange" ? { q: Array.from(angles) } : { q: Array.from(angles), tool };
  return addSteps(words.undo.recordPoint, program => [
    {
      id: freshStepId(program, "p"),
      type: "move",
      path: "circ",
      speed: { mps: 0.1 },
      blend_m: 0,
      via: target(via_rad),
      target: target(q_rad),
    },
  ]);
}
export const addWait = (s: number): boolean =>
  addSteps(words.undo.addWait, program => [{ id: freshStepId(program, "w"), type: "wait", s }]);
export const addGripper = (closed: boolean): boolean =>
  addSteps(words.undo.addGripper, program => [{ id: freshStepId(program, "g"), type: "gripper", closed }]);

export const addComment = (): boolean =>
  addSteps(words.undo.addComment, program => [{ id: freshStepId(program, "c"), type: "comment", text: "" }]);
/** A signal the program has is taken; one that has none gets its first. */
export const addSet = (): boolean => {
  const name = lineOf("digital-out") ?? words.step.output;
  return addSteps(
    words.undo.addSet,
    program => [{ id: freshStepId(program, "o"), type: "set", signal: name, to: true }],
    program => withLine(program, name, { kind: "digital-out", address: 1 }),
  );
};
export const addWaitFor = (): boolean => {
  const name = lineOf("digital-in") ?? words.step.input;
  return addSteps(
    words.undo.addWaitFor,
    program => [{ id: freshStepId(program, "i"), type: "wait-for", when: { signal: name, is: true } }],
    program => withLine(program, name, { kind: "digital-in", address: 1001 }),
  );
};
const lineOf = (kind: SignalLine["kind"]): string | undefined =>
  Object.entries(theProgram()?.signals ?? {}).find(([, line]) => line.kind === kind)?.[0];
const withLine = (program: Program, name: string, line: SignalLine): Program =>
  Object.hasOwn(program.signals, name) ? program : withSignal(program, name, line);
/** A loop around the selected step, or an empty one. */
export function addRepeat(): boolean {
  const program = theProgram();
  const { selected } = selectionStore.getState();
  if (!program) return false;
  const id = freshStepId(program, "r");
  const around = selected?.kind === "step" && findStep(program, selected.id) ? selected.id : undefined;
  const done =
    around === undefined
      ? addSteps(words.undo.addRepeat, () => [{ id, type: "repeat", times: 2, steps: [] }])
      : edit(words.undo.addRepeat, before => wrapInRepeat(before, [around], 2));
  if (done) select({ kind: "step", id });
  return done;
}

/** A loop or a decision around nothing yet, by the first input of the program. */
const asking = (): { readonly when: Predicate; readonly name: string } => {
  const name = lineOf("digital-in") ?? words.step.input;
  return { name, when: { signal: name, is: true } };
};
export const addWhile = (): boolean => {
  const { name, when } = asking();
  return addSteps(
    words.undo.addWhile,
    program => [{ id: freshStepId(program, "r"), type: "while", when, steps: [] }],
    program => withLine(program, name, { kind: "digital-in", address: 1001 }),
  );
};
export const addIf = (): boolean => {
  const { name, when } = asking();
  return addSteps(
    words.undo.addIf,
    program => [{ id: freshStepId(program, "d"), type: "if", when, then: [], else: [] }],
    program => withLine(program, name, { kind: "digital-in", address: 1001 }),
  );
};
/** Counts up the first whole number of the program; one that has none gets its first. */
export const addAssign = (): boolean => {
  const known = Object.entries(theProgram()?.variables ?? {}).find(([, { type }]) => type === "int")?.[0];
  const variable = known ?? FIRST_VARIABLE;
  return addSteps(
    words.undo.addAssign,
    program => [
      {
        id: freshStepId(program, "v"),
        type: "assign",
        variable,
        to: { op: "+", of: [{ variable }, 1] },
      },
    ],
    program => (known === undefined ? withVariable(program, variable, { type: "int" }) : program),
  );
};
const FIRST_VARIABLE = "count";
const withVariable = (program: Program, name: string, variable: Variable): Program => ({
  ...program,
  variables: { ...program.variables, [name]: variable },
});
/** Gives the program a variable, or another type and first value to one that it has. */
export const setVariable = (name: string, variable: Variable): boolean =>
  edit(words.undo.variable, program => withVariable(program, name, variable));
/** Takes variables out that no step names. */
export const removeVariables = (names: readonly string[]): boolean =>
  edit(words.undo.variable, ({ variables = {}, ...program }) => {
    const left = Object.entries(variables).filter(([name]) => !names.includes(name));
    return left.length === 0 ? program : { ...program, variables: Object.fromEntries(left) };
  });
export const addCall = (): boolean => {
  const program = theProgram();
  const { selected } = selectionStore.getState();
  const within =
    selected?.kind === "routine"
      ? selected.name
      : selected?.kind === "step" && program
        ? routineOf(program, selected.id)
        : undefined;
  const routine = program === null ? undefined : callableFrom(program, within)[0];
  if (program === null || routine === undefined) return false;
  return addSteps(words.undo.addCall, before => [
    { id: freshStepId(before, "k"), type: "call", routine, ...firstArguments(before, routine) },
  ]);
};
/** No, or 0, for every parameter of a routine. */
export function firstArguments(program: Program, routine: string): Pick<Extract<Step, { type: "call" }>, "arguments"> {
  const wanted = Object.entries(program.parameters?.[routine] ?? {});
  if (wanted.length === 0) return {};
  return {
    arguments: Object.fromEntries(wanted.map(([name, type]) => [name, nothingOf(type)])),
  };
}

export function changeStep(id: string, label: string, change: (step: Step) => Step, gesture?: string): boolean {
  return edit(
    label,
    program => {
      const before = stepById(program, id);
      if (!before) return program;
      const after = change(before);
      return after === before ? program : replaceStep(program, id, after);
    },
    gesture,
  );
}
export const changeMove = (
  id: string,
  label: string,
  change: (step: MoveStep) => MoveStep,
  gesture?: string,
): boolean => changeStep(id, label, step => (step.type === "move" ? change(step) : step), gesture);
/** Row L-42 in its first form: the point becomes where the robot stands. */
export const touchUp = (
  id: string,
  q_rad: ArrayLike<number>,
  tool: string,
  place: (target: Target, before: Target) => Target = target => target,
): boolean =>
  changeMove(id, words.undo.touchUp, step => ({
    ...step,
    target: place(tool === "flange" ? { q: Array.from(q_rad) } : { q: Array.from(q_rad), tool }, step.target),
  }));
export const renameStep = (id: string, name: string): boolean =>
  changeStep(id, words.undo.rename, step => {
    const { name: before, ...rest } = step;
    const wanted = name.trim();
    if (wanted === (before ?? "")) return step;
    return wanted === "" ? rest : { ...rest, name: wanted };
  });

export function deleteSteps(ids: readonly string[]): boolean {
  const before = theProgram();
  const first = before ? Array.from(everyStep(before)).findIndex(step => ids.includes(step.id)) : -1;
  if (!edit(words.undo.deleteSteps(ids.length), program => removeSteps(program, ids))) return false;
  const after = theProgram();
  const left = after ? [...everyStep(after)] : [];
  const next = left[Math.min(Math.max(0, first), left.length - 1)];
  select(next ? { kind: "step", id: next.id } : null);
  return true;
}
export const copySteps = (ids: readonly string[]): boolean =>
  edit(words.undo.duplicate, program => duplicateSteps(program, ids));
/** Puts the steps, in their order, before the step `before`, into a list, or at the end when it is null. */
export const placeSteps = (ids: readonly string[], before: string | null | ListPlace): boolean =>
  edit(words.undo.reorder, program => {
    if (before === null) return moveSteps(program, ids, program.steps.length);
    if (typeof before !== "string" || before === "main")
      return moveInto(program, ids, before, Number.POSITIVE_INFINITY);
    return ids.includes(before) ? program : moveBefore(program, ids, before);
  });
export function clearProgram(): boolean {
  const done = edit(words.undo.clear, program =>
    program.steps.length === 0 ? program : { ...program, steps: [], groups: {} },
  );
  if (done) select(null);
  return done;
}
export const repairStep = (id: string, repair: Repair): boolean =>
  edit(words.undo.repair, program => applyRepair(program, id, repair));
/** Several repairs are one undo step. */
export const repairAll = (repairs: readonly { readonly id: string; readonly repair: Repair }[]): boolean =>
  edit(words.undo.repairAll, program => repairs.reduce((so, { id, repair }) => applyRepair(so, id, repair), program));

/** The first repair of every step that has one. */
export const firstRepairs = (verdict: Verdict | null): readonly { readonly id: string; readonly repair: Repair }[] =>
  (verdict?.steps ?? []).flatMap(step => {
    const repair = step.findings.find(finding => finding.repairs.length > 0)?.repairs[0];
    return repair ? [{ id: step.id, repair }] : [];
  });

/** How many steps Repair all is for: the bad ones, or, where none is bad, those with something to better. */
export function stepsToRepair(verdict: Verdict | null): number {
  const bad = (verdict?.steps ?? []).filter(step => step.verdict === "bad").length;
  return bad > 0 ? bad : firstRepairs(verdict).length;
}

/** What a person reads for a step that has no name of its own. */
export function stepWords(step: Step, index: number): string {
  if (step.name) return step.name;
  switch (step.type) {
    case "move":
      return words.step.point(index + 1);
    case "wait":
      return words.step.wait(step.s);
    case "gripper":
      return step.closed ? words.step.close : words.step.open;
    case "set":
      return step.pulse_s === undefined
        ? words.step.set(step.signal, level(step.to))
        : words.step.pulse(step.signal, level(step.to), step.pulse_s);
    case "wait-for":
      return words.step.waitFor(conditionWords(step.when));
    case "payload":
      return words.step.payload(step.mass_kg);
    case "message":
      return words.step.say(step.text);
    case "stop":
      return words.step.stop;
    case "comment":
      return step.text === "" ? words.step.comment : step.text;
    case "call":
      return words.step.call(step.routine);
    case "assign":
      return words.step.assign(step.variable, printExpression(step.to));
    case "while":
      return words.step.while(conditionWords(step.when));
    case "repeat":
      return step.times === "forever" ? words.step.forever : words.step.repeat(step.times);
    case "if":
      return words.step.if(conditionWords(step.when));
    case "pallet":
      return words.step.pallet(step.pallet);
  }
}

const level = (to: boolean | number): string =>
  typeof to === "number" ? String(to) : to ? words.common.on : words.common.off;
/** A condition as it stands in a sentence. */
export function conditionWords(when: Predicate): string {
  if ("expression" in when) return predicateText(when);
  if ("is" in when) return words.step.is(when.signal, level(when.is));
  return "above" in when ? words.step.above(when.signal, when.above) : words.step.below(when.signal, when.below);
}
