import {
  angleBetween,
  compose,
  distance,
  distanceToPolyline,
  flangePose,
  planProgram,
  robotById,
  samplePlan,
  type MoveStep,
  type Pose,
  type Vector3,
} from "@twincell/core";
import { edgeTraceCell } from "@twincell/project";
import { afterEach, beforeEach, expect, test } from "vitest";
import { cellStore } from "../../stores/cell.ts";
import { redo, showDocument, theProgram, undo } from "../../stores/document.ts";
import { jogStore } from "../../stores/jog.ts";
import { noticeStore } from "../../stores/notices.ts";
import { RECORD_EVERY_M, RECORD_EVERY_RAD, recordMoving, recordStore } from "../../stores/record.ts";
import { beginDrag, dragFollows, dragTcp } from "./drag.ts";
import { startFollowing } from "../robot/follow.ts";
import { onFrame, tick } from "./jog-frames.ts";
import { MAX_POINTS, startHandPath } from "./hand-path.ts";
import { hold, release, releaseAll } from "./pressed-inputs.ts";
import { startJogging } from "./jogger.ts";
import { showJoints, tcpNow, theLive } from "../live.ts";

const robot = robotById("staubli_rx90l")!;
const cell = edgeTraceCell();
const { flangeFromTcp } = cell.tools[0]!;
const { worldFromBase } = cell.robot;
const START = [0, -60, 110, 0, 40, 0].map(angle => (angle * Math.PI) / 180);
const DT_MS = 1000 / 60;
let now_ms = 1e6;
let ends: (() => void)[] = [];
let hand: Pose<"world", "tcp">[] = [];
const frames = (count: number): void => {
  for (let i = 0; i < count; i++) tick((now_ms += DT_MS));
};
const recorded = (): readonly MoveStep[] =>
  theProgram()!.steps.filter(
    (step): step is MoveStep => step.type === "move" && step.group?.startsWith("path-") === true,
  );

beforeEach(() => {
  releaseAll();
  showDocument(cell);
  ends = [
    startFollowing(),
    startJogging(),
    startHandPath(),
    onFrame(() => {
      hand.push(tcpNow());
    }),
  ];
  dragFollows(robot, worldFromBase, flangeFromTcp);
  showJoints(START);
  jogStore.setState({ frame: "world", manner: "hold", speed: 0.5, blocked: null });
  recordMoving(false);
  frames(2);
  hand = [tcpNow()];
});
afterEach(() => {
  for (const end of ends) end();
});

/**
 * Largest distance and turn between the way of the hand and the planned way of the recorded program, looked at from
 * both sides.
 */
function deviation(): { m: number; rad: number } {
  const planned = planProgram(theProgram()!, robot, { worldFromBase, start_rad: START });
  if (planned.kind !== "planned") throw new Error(JSON.stringify(planned));
  const q = new Float64Array(6);
  const way: Pose<"world", "tcp">[] = [];
  for (let t_s = 0; t_s <= planned.plan.duration_s; t_s += 0.004) {
    samplePlan(planned.plan, t_s, q);
    way.push(compose(compose(worldFromBase, flangePose(robot.arm, q)), flangeFromTcp));
  }
  const lines = {
    hand: hand.map(({ position }): Vector3 => [...position]),
    way: way.map(({ position }): Vector3 => [...position]),
  };
  const m = Math.max(
    ...lines.hand.map(point => distanceToPolyline(lines.way, point)),
    ...lines.way.map(point => distanceToPolyline(lines.hand, point)),
  );
  const rad = Math.max(
    ...hand.map(pose =>
      Math.min(
        ...way
          .filter(other => distance(other.position, pose.position) < 0.006)
          .map(other => angleBetween(other.quaternion, pose.quaternion)),
      ),
    ),
  );
  return { m, rad };
}

test("N-57 while switched on, the way of a jogging hand is recorded and its replay stays within 1 mm and 1° of it", () => {
  recordMoving(true);
  hold("pendant", 0, -1);
  frames(45);
  hold("gamepad", 2, -0.6);
  hold("gamepad", 4, 0.5);
  frames(60);
  release("pendant");
  frames(30);
  releaseAll();
  frames(3);
  const steps = recorded();
  expect(steps.length).toBeGreaterThan(60);
  expect(steps.length).toBeLessThan(140);
  expect(new Set(steps.map(step => step.group))).toEqual(new Set(["path-1"]));
  expect(theProgram()!.groups["path-1"]).toEqual({ name: "Recorded path" });
  expect(steps.every(step => step.path === "ptp")).toBe(true);
  expect(steps.slice(0, -1).every(step => step.blend_m > 0)).toBe(true);
  expect(steps.at(-1)!.blend_m).toBe(0);
  const ending = steps.at(-1)!.target;
  expect("q" in ending && ending.q).toEqual([...theLive().q_rad]);
  const { m, rad } = deviation();
  expect(m).toBeLessThan(RECORD_EVERY_M);
  expect(rad).toBeLessThan(RECORD_EVERY_RAD);
});

test("N-57 several strokes are one group and one undo step, and the point they share is there once", () => {
  const before = theProgram()!;
  recordMoving(true);
  for (const axis of [1, 2]) {
    hold("keyboard", axis, -1);
    frames(30);
    releaseAll();
    frames(20);
  }
  recordMoving(false);
  frames(1);
  expect(new Set(recorded().map(step => step.group))).toEqual(new Set(["path-1"]));
  expect(recorded().filter(step => step.blend_m === 0)).toHaveLength(2);
  const configurations = recorded().map(step => JSON.stringify(step.target));
  expect(new Set(configurations).size).toBe(configurations.length);
  expect(cellStore.getState().undo).toEqual(["Record path"]);
  expect(deviation().m).toBeLessThan(RECORD_EVERY_M);
  undo();
  expect(theProgram()!.steps).toEqual(before.steps);
  redo();
  expect(recorded().length).toBe(configurations.length);
});

test("N-57 a drag of the tool is recorded, a slow hand gives points 1 mm apart and not one a frame", () => {
  recordMoving(true);
  const end = beginDrag(() => undefined);
  const from = tcpNow();
  for (let i = 1; i <= 200; i++) {
    dragTcp({
      position: [from.position[0] - 0.0001 * i, from.position[1], from.position[2] - 0.00005 * i],
      quaternion: from.quaternion,
    });
    frames(1);
  }
  end();
  frames(1);
  expect(recorded().length).toBeGreaterThan(15);
  expect(recorded().length).toBeLessThan(26);
  expect(deviation().m).toBeLessThan(RECORD_EVERY_M);
});

test("N-57 nothing is recorded while it is off, nor what moves the robot by itself", () => {
  hold("pendant", 0, -1);
  frames(30);
  releaseAll();
  frames(1);
  recordMoving(true);
  showJoints(START);
  frames(5);
  expect(recorded()).toHaveLength(0);
});

test("N-57 a stroke without end stops recording at its bound and says so", () => {
  recordMoving(true);
  jogStore.setState({ frame: "joint" });
  for (let i = 0; i < 2 * MAX_POINTS && recordStore.getState().moving; i++) {
    hold("pendant", 0, i % 120 < 60 ? 1 : -1);
    frames(1);
  }
  expect(recordStore.getState().moving).toBe(false);
  expect(recorded()).toHaveLength(MAX_POINTS);
  expect(noticeStore.getState().notices.at(-1)?.sentence).toContain("2000 points");
});
