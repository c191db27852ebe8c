import { compose, flangePose, robotById, type Pose } from "@twincell/core";
import { edgeTraceCell } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { showDocument } from "../../stores/document.ts";
import { jogStore } from "../../stores/jog.ts";
import { soundStore } from "../../stores/sound.ts";
import { startFollowing } from "../robot/follow.ts";
import { hold, release, releaseAll } from "./pressed-inputs.ts";
import { createJogger, LOCK_MS, type Jogger } from "./jogger.ts";
import { showJoints, theLive } from "../live.ts";

const DT = 1 / 60;
const robot = robotById("staubli_rx90l")!;
const START = [0, -60, 110, 0, 40, 0].map(angle => (angle * Math.PI) / 180);
let jogger: Jogger;
let now_ms = 0;
const run = (frames: number): void => {
  for (let i = 0; i < frames; i++) {
    now_ms += DT * 1000;
    jogger.step(now_ms, DT);
  }
};
const tcp = (): readonly number[] => [...theLive().worldFromTcp.position];

beforeEach(() => {
  releaseAll();
  showDocument(edgeTraceCell());
  startFollowing();
  jogger = createJogger();
  showJoints(START);
  jogStore.setState({ frame: "world", manner: "hold", speed: 0.5, blocked: null });
  run(1);
});

test("N-38 holding moves the TCP along the chosen axis by speed times time, letting go stops it", () => {
  const before = tcp();
  hold("pendant", 0, -1);
  run(60);
  release("pendant");
  const after = tcp();
  run(30);
  expect(after[0]! - before[0]!).toBeCloseTo(-0.5 * 0.25, 6);
  expect(after[1]).toBeCloseTo(before[1]!, 9);
  expect(tcp()).toEqual(after);
});

test("steps: one press is one step however long it is held", () => {
  jogStore.setState({ manner: "steps", step_m: 0.005 });
  const before = tcp();
  hold("keyboard", 2, -1);
  run(60);
  expect(tcp()[2]! - before[2]!).toBeCloseTo(-0.005, 7);
  release("keyboard");
  run(2);
  hold("keyboard", 2, -1);
  run(1);
  release("keyboard");
  run(60);
  expect(tcp()[2]! - before[2]!).toBeCloseTo(-0.01, 7);
});

test("N-39, N-40 at a limit the joint blocks, one sound plays, and nothing moves for 500 ms although other axes are held", () => {
  jogStore.setState({ frame: "joint", speed: 1 });
  const limit = robot.arm.joints[4]!.limits.upper_rad;
  const sounds = soundStore.getState().played.limit;
  hold("gamepad", 4, 1);
  for (let i = 0; i < 600 && jogStore.getState().blocked === null; i++) run(1);
  expect(theLive().q_rad[4]).toBeCloseTo(limit, 9);
  expect(jogStore.getState().blocked).toMatchObject({ joint: 5 });
  expect(jogStore.getState().blocked?.sentence).toContain("its limit is 120.0°.");
  expect(soundStore.getState().played.limit).toBe(sounds + 1);
  hold("gamepad", 0, 1);
  const stood = theLive().q_rad[0];
  const locked_from = now_ms;
  while (theLive().q_rad[0] === stood && now_ms < locked_from + 2000) run(1);
  expect(now_ms - locked_from).toBeGreaterThan(LOCK_MS - 20);
  expect(now_ms - locked_from).toBeLessThan(LOCK_MS + 40);
  run(30);
  expect(soundStore.getState().played.limit).toBe(sounds + 1);
  releaseAll();
  run(2);
  expect(jogStore.getState().blocked).toBeNull();
});

test("a command that is not a number moves nothing", () => {
  const before = tcp();
  hold("headset", 0, Number.NaN);
  run(10);
  expect(tcp()).toEqual(before);
});

test("the live TCP is forward kinematics of base, arm and tool", () => {
  const { q_rad, worldFromTcp } = theLive();
  const cell = edgeTraceCell();
  const wanted: Pose<"world", "tcp"> = compose(
    compose(cell.robot.worldFromBase, flangePose(robot.arm, q_rad)),
    cell.tools[0]!.flangeFromTcp,
  );
  for (let i = 0; i < 3; i++) expect(worldFromTcp.position[i]).toBeCloseTo(wanted.position[i]!, 12);
});

test("N-40 a push held on at the edge of reach sounds once, however uneven the frames are, and again after it was let go", () => {
  jogStore.setState({ speed: 1 });
  const sounds = soundStore.getState().played.limit;
  hold("gamepad", 0, 1);
  for (let i = 0; i < 600 && jogStore.getState().blocked === null; i++) {
    now_ms += 100;
    jogger.step(now_ms, 0.1);
  }
  expect(soundStore.getState().played.limit).toBe(sounds + 1);
  for (let i = 0; i < 400; i++) {
    const dt_s = [0.1, 0.004, 0.016, 0.001, 0.05][i % 5]!;
    now_ms += 1000 * dt_s;
    jogger.step(now_ms, dt_s);
  }
  expect(soundStore.getState().played.limit).toBe(sounds + 1);
  release("gamepad");
  run(2);
  hold("gamepad", 0, 1);
  run(10);
  expect(soundStore.getState().played.limit).toBe(sounds + 2);
});
