import { checkProgram, linkSolids, robotById, type MoveStep, type Program } from "@twincell/core";
import { cellGeometry, selectedProgram, tracedCartonCell, type CellDocument } from "@twincell/project";
import { afterEach, beforeEach, expect, test } from "vitest";
import { cellStore } from "../../stores/cell.ts";
import { connectionStore } from "../../stores/connection.ts";
import { showDocument, undo } from "../../stores/document.ts";
import { editStore } from "../../stores/edit-point.ts";
import { noticeStore } from "../../stores/notices.ts";
import { playStore } from "../../stores/play.ts";
import { selectionStore } from "../../stores/selection.ts";
import { stopEverything } from "../../stores/stop.ts";
import { showJoints, theLive } from "../live.ts";
import { startFollowing } from "../robot/follow.ts";
import { beginEdit, endEdit } from "./edit-point.ts";
import { tick } from "./jog-frames.ts";

const cell = tracedCartonCell();
const robot = robotById(cell.robot.id)!;
const program = cell.programs[0] as Program;
const DEG = Math.PI / 180;
/** Joint 5 stands 3° beyond its limit. */
const BAD = [0, -1.2, 1.9, 0, 123 * DEG, 0];
const bad: MoveStep = {
  id: "bad",
  name: "Bad point",
  type: "move",
  path: "ptp",
  speed: { ratio: 0.2 },
  blend_m: 0,
  target: { q: BAD, tool: cell.tool },
};
const broken: CellDocument = { ...cell, programs: [{ ...program, steps: [...program.steps.slice(0, 1), bad] }] };
const now = (): CellDocument => cellStore.getState().document!;
const target = (): MoveStep["target"] =>
  (selectedProgram(now())!.steps.find(({ id }) => id === "bad") as MoveStep).target;
const verdictOfBad = (): string => {
  const document = now();
  const { verdict } = checkProgram(selectedProgram(document)!, robot, {
    cell: cellGeometry(document, linkSolids(robot)),
  });
  playStore.setState({ verdict });
  return verdict.steps.find(({ id }) => id === "bad")!.verdict;
};
let now_ms = 0;
const frames = (count: number): void => {
  for (let i = 0; i < count; i++) tick((now_ms += 16));
};
const said = (): string => noticeStore.getState().notices.at(-1)?.sentence ?? "";
/** Near the bad point: joint 5 as far as it goes, and some joints a little off. */
const NEAR = [0.03, -1.2, 1.9, 0, 110 * DEG, 0];

let stopFollowing: () => void;
beforeEach(() => {
  connectionStore.setState({ station: null });
  showDocument(broken);
  stopFollowing = startFollowing();
  showJoints(NEAR);
});
afterEach(() => {
  endEdit();
  stopFollowing();
});

test("L-42 near a bad pose EDIT snaps the tool to it; moved and let go, the point is there, the step is no longer bad, as one edit", () => {
  expect(verdictOfBad()).toBe("bad");
  expect(beginEdit()).toBe(true);
  expect(editStore.getState().edited).toMatchObject({ step: "bad", name: "Bad point" });
  expect(selectionStore.getState().selected).toEqual({ kind: "step", id: "bad" });
  frames(300);
  // As near as the robot can: joint 5 ends at its limit, or the arm bends round it.
  for (const [joint, { limits }] of robot.arm.joints.entries()) {
    expect(theLive().q_rad[joint]).toBeGreaterThanOrEqual(limits.lower_rad - 1e-9);
    expect(theLive().q_rad[joint]).toBeLessThanOrEqual(limits.upper_rad + 1e-9);
  }
  expect(target()).toEqual(bad.target);
  const good = [0, -1.2, 1.9, 0, 100 * DEG, 0];
  showJoints(good.map((angle, i) => (angle + theLive().q_rad[i]!) / 2));
  frames(20);
  // Judged again while it is moved.
  expect(target()).not.toEqual(bad.target);
  showJoints(good);
  endEdit();
  expect(target()).toEqual({ q: good, tool: cell.tool });
  expect(verdictOfBad()).toBe("ok");
  expect(said()).toBe("Bad point is stored.");
  undo();
  expect(target()).toEqual(bad.target);
});

test("EDIT let go without a motion changes nothing", () => {
  beginEdit();
  frames(300);
  endEdit();
  expect(now().programs).toEqual(broken.programs);
  expect(editStore.getState().edited).toBeNull();
});

test("far from every point EDIT says how far the nearest is, and moves nothing", () => {
  showJoints([1.5, ...NEAR.slice(1)]);
  const before = [...theLive().q_rad];
  expect(beginEdit()).toBe(false);
  frames(10);
  expect([...theLive().q_rad]).toEqual(before);
  expect(said()).toMatch(/^The nearest point, .+, is \d+ mm away\.$/);
});

test("a point is not edited with a connected robot, and STOP ends EDIT", () => {
  connectionStore.setState({ station: "arm-1", view: "live" });
  expect(beginEdit()).toBe(false);
  expect(editStore.getState().edited).toBeNull();
  connectionStore.setState({ station: null });
  expect(beginEdit()).toBe(true);
  stopEverything();
  expect(editStore.getState().edited).toBeNull();
});
