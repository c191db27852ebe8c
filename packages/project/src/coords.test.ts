import {
  compose,
  flangePose,
  planProgram,
  pose,
  posesAgree,
  robotById,
  samplePlan,
  fromAxisAngle,
  type Pose,
} from "@twincell/core";
import { expect, test } from "vitest";
import { addCoords, editCoords, removeCoords, savedCoords, trajectoryThroughCoords } from "./coords.ts";
import type { CellDocument } from "./document.ts";
import { edgeTraceCell } from "./example/index.ts";
import { createHistory } from "./history.ts";
import { openDocument } from "./open.ts";
import { selectedProgram } from "./programs.ts";
import { saveDocument } from "./save.ts";

const robot = robotById("staubli_rx90l")!;
const cell = edgeTraceCell();
const { flangeFromTcp } = cell.tools[0]!;
const tcpAt = (q: readonly number[]): Pose<"world", "tcp"> =>
  compose(compose(cell.robot.worldFromBase, flangePose(robot.arm, q)), flangeFromTcp);
const postures = [
  [0.2, -1.3, 1.9, 0.1, 0.8, 0],
  [-0.3, -1.1, 1.8, 0, 0.9, 0.2],
  [0.1, -1.2, 2.1, 0.2, 0.7, 0.1],
];
const poses = postures.map(tcpAt);
const three = (): CellDocument => poses.reduce<CellDocument>((so, each) => addCoords(so, each), cell);
const names = (so: CellDocument): readonly string[] => savedCoords(so).map(frame => frame.name);

test("L-44 AddCoords: a frame is added where the tool tip is, under a name of its own, and is saved with the cell", () => {
  const after = three();
  expect(names(after)).toEqual(["Pose", "Pose 2", "Pose 3"]);
  for (const [i, frame] of savedCoords(after).entries())
    expect(frame.worldFromFrame).toEqual({ position: [...poses[i]!.position], quaternion: [...poses[i]!.quaternion] });
  expect(after.frames.slice(0, cell.frames.length)).toEqual(cell.frames);
  expect(openDocument(saveDocument(after))).toMatchObject({ kind: "opened", document: after });
  expect(names(addCoords(after, poses[0]!, "Carton corner"))).toContain("Carton corner 2");
});

test("L-45 EditCoords: a saved pose moves, also to where the robot cannot go, and its moves go along", () => {
  const before = trajectoryThroughCoords(three(), ["Pose", "Pose 2"]);
  const far = pose<"world", "tcp">([9, 0, 1], fromAxisAngle([1, 0, 0], 1));
  const after = editCoords(before, "Pose 2", far);
  expect(savedCoords(after)[1]).toEqual({
    name: "Pose 2",
    worldFromFrame: { position: [...far.position], quaternion: [...far.quaternion] },
    saved: true,
  });
  expect(selectedProgram(after)!.frames["Pose 2"]!.position).toEqual([9, 0, 1]);
  expect(planProgram(selectedProgram(after)!, robot, { worldFromBase: cell.robot.worldFromBase })).not.toMatchObject({
    kind: "planned",
  });
  // A user frame is no saved pose, and a name that is not there is none.
  expect(editCoords(before, "carton", far)).toBe(before);
  expect(editCoords(before, "nobody", far)).toBe(before);
});

test("L-48 RemoveCoords: every saved pose is gone, frames of the cell stay, moves stay where they went; undo brings all back", () => {
  const before = trajectoryThroughCoords(three(), ["Pose", "Pose 3"]);
  const after = removeCoords(before);
  expect(savedCoords(after)).toEqual([]);
  expect(after.frames).toEqual(cell.frames);
  const targets = selectedProgram(after)!.steps.map(step => (step.type === "move" ? step.target : null));
  for (const [i, wanted] of [poses[0]!, poses[2]!].entries()) {
    const target = targets[i]!;
    if (!target || !("pose" in target)) throw new Error("A pose was wanted.");
    expect(target.frame).toBe("world");
    expect(posesAgree(target.pose, wanted, 1e-12, 1e-9)).toBe(true);
  }
  expect(openDocument(saveDocument(after)).kind).toBe("opened");
  expect(removeCoords(after)).toBe(after);
  expect(createHistory(before).commit("remove", after).undo().document).toEqual(before);
});

test("L-49 saved poses are reused: a trajectory goes through them in the order asked for, as often as asked for", () => {
  const order = ["Pose 3", "Pose", "Pose 2", "Pose"];
  const after = trajectoryThroughCoords(three(), [...order, "nobody"]);
  const program = selectedProgram(after)!;
  expect(program.steps.map(step => step.name)).toEqual(order);
  const planned = planProgram(program, robot, { worldFromBase: cell.robot.worldFromBase });
  if (planned.kind !== "planned") throw new Error(JSON.stringify(planned.stuck));
  const q = new Float64Array(6);
  for (const [i, step] of program.steps.entries()) {
    const end = planned.plan.segments.findLast(segment => segment.step === step.id)!;
    samplePlan(planned.plan, end.start_s + end.duration_s - 1e-9, q);
    const wanted = savedCoords(after).find(frame => frame.name === order[i])!.worldFromFrame;
    expect(posesAgree(tcpAt(Array.from(q)), wanted, 1e-6, 1e-5)).toBe(true);
  }
  expect(trajectoryThroughCoords(cell, order)).toBe(cell);
});
