import { distance, robotById, type Vector3 } from "@twincell/core";
import { edgeTraceCell } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { collideStore } from "../../stores/collide.ts";
import { showDocument } from "../../stores/document.ts";
import { followTargetStore, showFollowTarget } from "../../stores/follow-target.ts";
import { jogStore } from "../../stores/jog.ts";
import { showJoints, theLive } from "../live.ts";
import { startFollowing } from "../robot/follow.ts";
import { theTarget } from "./follow-target.ts";
import { createJogger, type Jogger } from "./jogger.ts";
import { hold, releaseAll } from "./pressed-inputs.ts";

const DT = 1 / 60;
const robot = robotById("staubli_rx90l")!;
const START = [0, -60, 110, 0, 40, 0].map(angle => (angle * Math.PI) / 180);
let jogger: Jogger;
let now_ms = 0;
const run = (frames: number): void => {
  for (let i = 0; i < frames; i++) jogger.step((now_ms += DT * 1000), DT);
};
const tool = (): Vector3 => [...theLive().worldFromTcp.position];
const sphere = (): Vector3 => [...theTarget().position];

beforeEach(() => {
  releaseAll();
  showDocument(edgeTraceCell());
  startFollowing();
  collideStore.setState({ behaviour: "alert" });
  jogger = createJogger();
  showJoints(START);
  showFollowTarget(true);
  jogStore.setState({ frame: "world", manner: "hold", speed: 0.5, blocked: null });
  run(1);
});

test("X-18 X-29 what is held moves the target by speed times time, and the tool is at it in every frame", () => {
  const before = sphere();
  expect(distance(before, tool())).toBe(0);
  hold("gamepad", 1, 1);
  for (let frame = 1; frame <= 60; frame++) {
    run(1);
    expect(distance(sphere(), tool())).toBeLessThan(1e-6);
  }
  releaseAll();
  run(1);
  expect(sphere()[1] - before[1]).toBeCloseTo(0.5 * 0.25, 9);
  expect(sphere()[0]).toBeCloseTo(before[0], 12);
  expect(followTargetStore.getState()).toMatchObject({ kind: "on-target", off_m: 0 });
});

test("X-29 a target out of reach is told of with its distance, the joints keep their speed, and the arm comes back with it", () => {
  jogStore.setState({ speed: 1 });
  hold("pendant", 0, 1);
  const before = Float64Array.from(theLive().q_rad);
  for (let frame = 0; frame < 600; frame++) {
    run(1);
    robot.arm.joints.forEach(({ limits }, j) => {
      expect(Math.abs(theLive().q_rad[j]! - before[j]!)).toBeLessThan(limits.speed_rad_s * DT + 1e-9);
    });
    before.set(theLive().q_rad);
  }
  const out = followTargetStore.getState();
  expect(out.kind).toBe("out-of-reach");
  expect(out.why).toMatch(/\.$/);
  expect(out.off_m).toBeCloseTo(distance(sphere(), tool()), 3);
  expect(out.off_m).toBeGreaterThan(0.5);
  releaseAll();
  hold("pendant", 0, -1);
  for (let frame = 0; frame < 1200 && followTargetStore.getState().kind !== "on-target"; frame++) run(1);
  expect(distance(sphere(), tool())).toBeLessThan(1e-6);
});

test("whoever else moves the robot takes the target along; a command that is not a number moves neither", () => {
  hold("keyboard", 2, 1);
  run(30);
  releaseAll();
  showJoints(START.with(0, 0.3));
  run(1);
  expect(sphere()).toEqual(tool());
  const before = sphere();
  hold("headset", 0, Number.NaN);
  run(10);
  expect(sphere()).toEqual(before);
});

test("steps: one press moves the target by one step", () => {
  jogStore.setState({ manner: "steps", step_m: 0.005 });
  const before = sphere();
  hold("keyboard", 2, -1);
  run(60);
  expect(sphere()[2] - before[2]).toBeCloseTo(-0.005, 9);
  expect(distance(sphere(), tool())).toBeLessThan(1e-6);
});
