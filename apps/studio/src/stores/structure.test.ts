import {
  flangePose,
  palletSlots,
  parseProgram,
  robotById,
  serializeProgram,
  unrolled,
  type Program,
} from "@twincell/core";
import { emptyCell } from "@twincell/project";
import { beforeEach, describe, expect, test } from "vitest";
import { commit, showDocument, theProgram, undo } from "./document.ts";
import { addCall, addGripper, addWait, recordPoint, touchUp } from "./program.ts";
import { newProgram } from "./programs.ts";
import { select } from "./selection.ts";
import {
  addMessage,
  addPallet,
  addPayload,
  addRoutine,
  addStop,
  bringProgram,
  choosePath,
  countFrom,
  countsFrom,
  deleteParameter,
  deleteRoutine,
  JOINTS,
  nameRoutine,
  otherPrograms,
  recordedTarget,
  setPallet,
  setParameter,
  takeCorner,
  touchedTarget,
} from "./structure.ts";

const robot = robotById("staubli_rx90l")!;
const Q = [0.2, -1.2, 1.9, 0.1, 0.8, 0.3];
const at = (q: readonly number[]) => {
  const { position, quaternion } = flangePose(robot.arm, q);
  return { position, quaternion };
};
/** The program as it would be opened again: nothing that was made in the editor is refused by the format. */
const program = (): Program => {
  const answer = parseProgram(JSON.parse(serializeProgram(theProgram()!)));
  if (answer.kind === "not-a-program") throw new Error(answer.faults.map(({ sentence }) => sentence).join(" "));
  return answer.program;
};
const record = (q: readonly number[]): void => {
  recordPoint("lin", q, "flange", recordedTarget);
};
beforeEach(() => {
  showDocument(emptyCell());
  select(null);
});

describe("a pallet", () => {
  test("M-54 one place and three corners make nine: a point recorded over place 1 is done over each of them", () => {
    const home = at(Q);
    addPallet(home);
    const [pallet] = Object.keys(program().pallets);
    expect(pallet).toBe("Pallet 1");
    const corner = (dx: number, dy: number): typeof home => ({
      ...home,
      position: [home.position[0] + dx, home.position[1] + dy, home.position[2]],
    });
    takeCorner(pallet!, "rowEnd", corner(0, 0.3));
    takeCorner(pallet!, "columnEnd", corner(0.2, 0));
    // Selected: the pallet step, so that what is recorded goes into it.
    record(Q);
    const steps = Array.from(unrolled(program()));
    expect(steps).toHaveLength(9);
    const slots = palletSlots(program().pallets[pallet!]!).map(({ position }) => position);
    expect(slots[2]![1] - slots[0]![1]).toBeCloseTo(0.3, 12);
    expect(slots[8]![0] - slots[0]![0]).toBeCloseTo(0.2, 12);
    // Far from place 1 a point is one place in the world: where the part is picked.
    record([-1.2, -1.2, 1.9, 0.1, 0.8, 0.3]);
    const inside = program().steps[0]!;
    expect(inside.type === "pallet" && inside.steps.map(step => step.type === "move" && "q" in step.target)).toEqual([
      false,
      true,
    ]);
  });

  test("around a point that was taught: the point is place 1, and undo gives it back as it was", () => {
    record(Q);
    const before = program().steps;
    addPallet(at([0, 0, 1, 0, 0, 0]));
    const [step] = program().steps;
    if (step?.type !== "pallet") throw new Error("a pallet step was expected");
    expect(step.steps[0]).toMatchObject({ target: { frame: "Pallet 1", pose: { position: [0, 0, 0] } } });
    expect(program().pallets["Pallet 1"]!.origin.position).toEqual(at(Q).position);
    setPallet("Pallet 1", pallet => ({ ...pallet, layers: 2, layer_m: 0.05, order: "rows-zigzag" }));
    expect(Array.from(unrolled(program()))).toHaveLength(18);
    undo();
    undo();
    expect(program().steps).toEqual(before);
  });

  test("place 1 taken anew brings the other corners along; a touched-up point still counts from the place", () => {
    addPallet(at(Q));
    record(Q);
    const [pallet] = program().steps;
    const id = pallet?.type === "pallet" ? pallet.steps[0]!.id : "";
    const nearby = Q.with(0, 0.23);
    touchUp(id, nearby, "flange", touchedTarget);
    const after = program().steps[0]!;
    expect(after.type === "pallet" && after.steps[0]).toMatchObject({ target: { frame: "Pallet 1" } });
    const there = at([-0.4, -1.2, 1.9, 0.1, 0.8, 0.3]);
    const [x, y] = program().pallets["Pallet 1"]!.origin.position;
    takeCorner("Pallet 1", "origin", there);
    const { origin, rowEnd } = program().pallets["Pallet 1"]!;
    expect(origin.position).toEqual(there.position);
    expect(rowEnd[0] - origin.position[0]).toBeCloseTo(0.2, 12);
    expect(Math.hypot(origin.position[0] - x, origin.position[1] - y)).toBeGreaterThan(0.3);
  });

  test("a target counts from the world, a place or is joints again, and stays where it is", () => {
    addPallet(at(Q));
    record([-1.2, -1.2, 1.9, 0.1, 0.8, 0.3]);
    const step = program().steps[0]!;
    const id = step.type === "pallet" ? step.steps[0]!.id : "";
    expect(countsFrom(theProgram()!, id)).toContain("Pallet 1");
    expect(countFrom(id, "world", () => undefined)).toBe(true);
    expect(countFrom(id, "Pallet 1", () => undefined)).toBe(true);
    expect(countFrom(id, JOINTS, () => undefined)).toBe(false);
    expect(countFrom(id, JOINTS, () => Float64Array.from(Q))).toBe(true);
    expect(program().steps[0]).toMatchObject({ steps: [{ target: { q: Q } }] });
  });
});

test("payload, message, end and an arc are added and can be saved; another path keeps no point of the arc", () => {
  addPayload();
  addMessage();
  record(Q);
  const { id } = program().steps[2]!;
  choosePath(id, "circ", Q.with(0, 0.4), "flange");
  expect(program().steps[2]).toMatchObject({ path: "circ", via: { q: Q.with(0, 0.4) } });
  choosePath(id, "spline", Q, "flange");
  expect(program().steps[2]).not.toHaveProperty("via");
  addStop();
  expect(program().steps.map(({ type }) => type)).toEqual(["payload", "message", "move", "stop"]);
});

test("a routine is made, filled, given a parameter, called and named; what is called is not deleted", () => {
  addRoutine();
  addGripper(true);
  expect(program().routines.Routine).toMatchObject([{ type: "gripper" }]);
  setParameter("Routine", "height", { type: "num", unit: "m" });
  select(null);
  addCall();
  expect(program().steps).toMatchObject([{ type: "call", arguments: { height: { value: 0, unit: "m" } } }]);
  expect(deleteRoutine("Routine")).toBe(false);
  nameRoutine("Routine", " Pick ");
  expect(program().steps).toMatchObject([{ routine: "Pick" }]);
  deleteParameter("Pick", "height");
  expect(program().parameters).toBeUndefined();
  select({ kind: "routine", name: "Pick" });
  // Nothing to call from inside that would come back.
  expect(addCall()).toBe(false);
});

test("N-70 another program is appended or called, in one step of undo", () => {
  addWait(1);
  addWait(2);
  const first = theProgram()!.name;
  newProgram();
  addWait(3);
  const before = program().steps;
  expect(otherPrograms().map(({ name }) => name)).toEqual([first]);
  bringProgram(first, "append");
  const waits = (): readonly number[] =>
    Array.from(unrolled(program()), step => (step.type === "wait" ? step.s : Number.NaN));
  expect(waits()).toEqual([3, 1, 2]);
  bringProgram(first, "call");
  expect(waits()).toEqual([3, 1, 2, 1, 2]);
  expect(Object.keys(program().routines)).toEqual([first]);
  undo();
  undo();
  expect(program().steps).toEqual(before);
  expect(commit("nothing", document => document)).toBe(false);
});
