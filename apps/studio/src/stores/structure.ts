import {
  compose,
  countedFrom,
  freeRoutineName,
  freshStepId,
  identity,
  insertAfter,
  insertInto,
  inverse,
  joinProgram,
  moveInto,
  palletsAround,
  palletSlot,
  placeOf,
  removeRoutine,
  renameRoutine,
  replaceStep,
  stepById,
  transformPoint,
  withoutParameter,
  withParameter,
  withRoutine,
  worldFromNamed,
  worldOfTarget,
  type MoveStep,
  type Pallet,
  type Pose,
  type Program,
  type SignalLine,
  type Step,
  type Target,
  type ValueType,
  type Vector3,
} from "@twincell/core";
import { isTextProgram } from "@twincell/project";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { commit, theProgram, theRobot, withProgram } from "./document.ts";
import { addSteps, changeMove, findStep, insertSelected } from "./program.ts";
import { select, selectionStore } from "./selection.ts";

/** What has a shape: pallets, routines, other programs, frames that targets count from. */

/** From one place to the next while nobody has said more [m]. */
const FIRST_PITCH_M = 0.1;
const FIRST_ROWS = 3;
/** A point this near to the line through place 1 is taught over that place, however near the next one is [m]. */
const LEAST_OVER_M = 0.02;

const edit = (label: string, change: (program: Program) => Program, gesture?: string): boolean =>
  commit(label, document => withProgram(document, change), gesture);
const worldFromBase = (): Pose<"world", "base"> => cellStore.getState().document?.robot.worldFromBase ?? identity();
const selectedStepId = (): string | undefined => {
  const { selected } = selectionStore.getState();
  return selected?.kind === "step" ? selected.id : undefined;
};

export const addPayload = (): boolean =>
  addSteps(words.editor.undo.payload, program => [
    { id: freshStepId(program, "l"), type: "payload", mass_kg: 1, center_m: [0, 0, 0.05] },
  ]);
export const addMessage = (): boolean =>
  addSteps(words.editor.undo.message, program => [
    { id: freshStepId(program, "m"), type: "message", text: words.editor.firstMessage },
  ]);
export const addStop = (): boolean =>
  addSteps(words.editor.undo.stop, program => [{ id: freshStepId(program, "e"), type: "stop" }]);

const nine = (frame: string, origin: Pose<"frame", "place">): Pallet => {
  const [x, y, z] = origin.position;
  const far = FIRST_PITCH_M * (FIRST_ROWS - 1);
  return {
    frame,
    origin,
    rowEnd: [x + far, y, z],
    columnEnd: [x, y + far, z],
    rows: FIRST_ROWS,
    columns: FIRST_ROWS,
    layers: 1,
    layer_m: 0,
  };
};

/**
 * A pallet: its place 1 is where the selected point is, which then is done at each place, else where the tool tip
 * stands. Rows and columns are taught by their corners, or typed.
 */
export function addPallet(worldFromTcp: Pose<"world", "tcp">): boolean {
  const before = theProgram();
  const robot = theRobot();
  if (!before || !robot) return false;
  const taken = { ...before.frames, ...before.pallets };
  let n = 1;
  while (Object.hasOwn(taken, words.editor.palletName(n))) n++;
  const name = words.editor.palletName(n);
  const id = freshStepId(before, "n");
  const selected = selectedStepId();
  const step = selected === undefined ? undefined : stepById(before, selected);
  const around = step?.type === "move" && palletsAround(before, step.id).length === 0 ? step : undefined;
  const at = around === undefined ? worldFromTcp : worldOfTarget(before, robot, worldFromBase(), around.target);
  if (at === undefined) return false;
  const origin: Pose<"frame", "place"> = { position: [...at.position], quaternion: [...at.quaternion] };
  const pallets = (program: Program): Program => ({
    ...program,
    pallets: { ...program.pallets, [name]: nine("world", origin) },
  });
  if (around === undefined)
    return addSteps(words.editor.undo.addPallet, () => [{ id, type: "pallet", pallet: name, steps: [] }], pallets);
  const done = edit(words.editor.undo.addPallet, program => {
    const place = placeOf(program, around.id);
    if (place === undefined) return program;
    const held = insertInto(pallets(program), place.where, place.at, [{ id, type: "pallet", pallet: name, steps: [] }]);
    const moved = moveInto(held, [around.id], { block: id }, 0);
    const target = countedFrom(moved, robot, worldFromBase(), around.target, name);
    return target === undefined ? program : replaceStep(moved, around.id, { ...around, target });
  });
  if (done) select({ kind: "step", id });
  return done;
}
export const setPallet = (name: string, change: (pallet: Pallet) => Pallet, gesture?: string): boolean =>
  edit(
    words.editor.undo.pallet,
    program => {
      const before = program.pallets[name];
      if (before === undefined) return program;
      const after = change(before);
      return after === before ? program : { ...program, pallets: { ...program.pallets, [name]: after } };
    },
    gesture,
  );
export type Corner = "origin" | "rowEnd" | "columnEnd";
/** A corner of a pallet becomes where the tool tip is. Moving place 1 takes the other two corners along. */
export function takeCorner(name: string, corner: Corner, worldFromTcp: Pose<"world", "tcp">): boolean {
  return setPallet(name, pallet => {
    const worldFromFrame = framed(pallet.frame);
    if (worldFromFrame === undefined) return pallet;
    const frameFromTcp = compose(inverse(worldFromFrame), worldFromTcp);
    if (corner !== "origin") return { ...pallet, [corner]: frameFromTcp.position };
    const by = frameFromTcp.position.map((value, k) => value - pallet.origin.position[k]!);
    const along = (point: Vector3): Vector3 => [point[0] + by[0]!, point[1] + by[1]!, point[2] + by[2]!];
    return {
      ...pallet,
      origin: { position: frameFromTcp.position, quaternion: frameFromTcp.quaternion },
      rowEnd: along(pallet.rowEnd),
      columnEnd: along(pallet.columnEnd),
    };
  });
}
const framed = (frame: string): Pose<"world", "frame"> | undefined => {
  const program = theProgram();
  return program === null ? undefined : worldFromNamed({ ...program, pallets: {} }, frame);
};

/** Whether a pose lies over or under place 1 of a pallet: within half a pitch of it, across the frame's z axis. */
function isOverPlace(program: Program, pallet: Pallet, worldFromTcp: Pose<"world", "tcp">): boolean {
  const worldFromFrame = worldFromNamed({ ...program, pallets: {} }, pallet.frame);
  if (worldFromFrame === undefined) return false;
  const [x, y] = transformPoint(inverse(worldFromFrame), worldFromTcp.position);
  const at = palletSlot(pallet, { layer: 0, row: 0, column: 0 }).position;
  const pitch = (end: Vector3, count: number): number =>
    count < 2 ? Infinity : Math.hypot(end[0] - at[0], end[1] - at[1]) / (count - 1);
  const least = Math.min(pitch(pallet.rowEnd, pallet.columns), pitch(pallet.columnEnd, pallet.rows));
  const reach_m = Math.max(LEAST_OVER_M, least / 2);
  return Math.hypot(x - at[0], y - at[1]) <= reach_m;
}

/**
 * The target of a point that is recorded now: inside a pallet step, over its place 1, it counts from the place, so that
 * it is done over every place. Everywhere else joints leave no doubt about the posture.
 */
export function recordedTarget(target: Target): Target {
  const program = theProgram();
  const robot = theRobot();
  const id = selectedStepId();
  if (!program || !robot || id === undefined) return target;
  const own = stepById(program, id);
  const open = [...palletsAround(program, id), ...(own?.type === "pallet" ? [own.pallet] : [])];
  const at = worldOfTarget(program, robot, worldFromBase(), target);
  const pallet = open.findLast(name => at !== undefined && isOverPlace(program, program.pallets[name]!, at));
  return pallet === undefined ? target : (countedFrom(program, robot, worldFromBase(), target, pallet) ?? target);
}

/** What a target can count from where the step stands: frames of the program, and pallets around it. */
export const countsFrom = (program: Program, id: string): readonly string[] => [
  "world",
  ...Object.keys(program.frames).filter(name => name !== "world"),
  ...palletsAround(program, id),
];
/** A target counts from another frame, or is joint angles; it stays where it is. False when it cannot be. */
export function countFrom(id: string, from: string, solve: (step: MoveStep) => Float64Array | undefined): boolean {
  const robot = theRobot();
  const program = theProgram();
  const step = program ? stepById(program, id) : undefined;
  if (!robot || !program || step?.type !== "move") return false;
  const { target } = step;
  if (from === JOINTS) {
    const q = "q" in target ? undefined : solve(step);
    if (q === undefined) return false;
    const { tool = "flange" } = target;
    const joints: Target = tool === "flange" ? { q: Array.from(q) } : { q: Array.from(q), tool };
    return changeMove(id, words.undo.target, before => ({ ...before, target: joints }));
  }
  const next = countedFrom(program, robot, worldFromBase(), target, from);
  return next !== undefined && changeMove(id, words.undo.target, before => ({ ...before, target: next }));
}
/** Stands for joint angles among the names of frames. */
export const JOINTS = "\0joints";

/** The path of a move. An arc passes where the robot stands; another path keeps no such point. */
export const choosePath = (id: string, path: MoveStep["path"], q_rad: ArrayLike<number>, tool: string): boolean =>
  changeMove(id, words.undo.path, before => {
    const { via, ...rest } = before;
    return path === "circ" ? { ...rest, path, via: via ?? jointsOf(q_rad, tool) } : { ...rest, path };
  });
/** An arc passes where the robot stands now. */
export const takeVia = (id: string, q_rad: ArrayLike<number>, tool: string): boolean =>
  changeMove(id, words.editor.undo.via, before =>
    before.path === "circ" ? { ...before, via: jointsOf(q_rad, tool) } : before,
  );
const jointsOf = (q_rad: ArrayLike<number>, tool: string): Target =>
  tool === "flange" ? { q: Array.from(q_rad) } : { q: Array.from(q_rad), tool };

/** Where a touched-up point is, counted from what it counted from before. */
export function touchedTarget(joints: Target, before: Target): Target {
  const robot = theRobot();
  const program = theProgram();
  if ("q" in before || !robot || !program) return joints;
  return countedFrom(program, robot, worldFromBase(), joints, before.frame) ?? joints;
}

/** A new routine, selected: what is added next goes into it. */
export function addRoutine(): boolean {
  const program = theProgram();
  if (!program) return false;
  const name = freeRoutineName(program, words.editor.routineName);
  if (!edit(words.editor.undo.routine, before => withRoutine(before, name))) return false;
  select({ kind: "routine", name });
  return true;
}
export function nameRoutine(name: string, wanted: string): boolean {
  const plain = wanted.trim();
  if (!edit(words.undo.rename, program => renameRoutine(program, name, plain))) return false;
  select({ kind: "routine", name: plain });
  return true;
}
export function deleteRoutine(name: string): boolean {
  const done = edit(words.editor.undo.removeRoutine(name), program => removeRoutine(program, name));
  if (done) select(null);
  return done;
}
export const setParameter = (routine: string, name: string, type: ValueType): boolean =>
  edit(words.editor.undo.parameter, program => withParameter(program, routine, name, type));
export const deleteParameter = (routine: string, name: string): boolean =>
  edit(words.editor.undo.parameter, program => withoutParameter(program, routine, name));

/** Other programs of steps in the cell that can be brought into this one: of the same robot, and not empty. */
export function otherPrograms(): readonly Program[] {
  const { document } = cellStore.getState();
  return (document?.programs ?? []).flatMap(program =>
    isTextProgram(program) || program.name === document?.program || program.steps.length === 0 ? [] : [program],
  );
}
/** Row N-70: another program of the cell goes on from here, or becomes a routine that is called here. */
export function bringProgram(name: string, how: "append" | "call"): boolean {
  const other = otherPrograms().find(program => program.name === name);
  if (other === undefined) return false;
  let last = "";
  const done = edit(words.editor.undo.bring(name), before => {
    const { program, steps } = joinProgram(before, other);
    let added: readonly Step[] = steps;
    let so = program;
    if (how === "call") {
      const routine = freeRoutineName(program, name);
      so = withRoutine(program, routine, steps);
      added = [{ id: freshStepId(so, "k"), type: "call", routine }];
    }
    last = added.at(-1)?.id ?? "";
    const selected = selectedStepId();
    // What is appended goes behind the whole block, or behind the last step; a call goes where a new step goes.
    if (how === "call") return insertSelected(so, added);
    const behind = selected === undefined ? undefined : findStep(before, selected)?.step.id;
    return behind === undefined ? insertInto(so, "main", Infinity, added) : insertAfter(so, behind, added);
  });
  if (done) select({ kind: "step", id: last });
  return done;
}

/** Gives the program a line, or another kind and address to one that it has. */
export const setLine = (name: string, line: SignalLine): boolean =>
  edit(words.undo.signal, program => ({ ...program, signals: { ...program.signals, [name]: line } }));
