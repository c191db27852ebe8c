import { robotById } from "@twincell/core";
import { edgeTraceCell } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { showDocument } from "../../stores/document.ts";
import { startFollowing } from "../robot/follow.ts";
import { tick } from "./jog-frames.ts";
import { endInterpolation, interpolateTo } from "./joint-interpolation.ts";
import { showJoints, theLive } from "../live.ts";

const robot = robotById("staubli_rx90l")!;
const TARGET = [0.8, -1, 1.2, 0.5, 0.6, -1.5];
const DT_S = 1 / 60;
let now_ms = 5e6;
beforeEach(() => {
  endInterpolation();
  showDocument(edgeTraceCell());
  startFollowing();
  showJoints(robot.home_rad);
  tick((now_ms += 1000 * DT_S));
});

test("N-19 a manual go-to moves smoothly: no joint jumps, none is faster than the 35 % it may use, and it ends exactly at its target", () => {
  let arrived: boolean | undefined;
  let before = Float64Array.from(theLive().q_rad);
  let fastest = 0;
  let frames = 0;
  const speeds: number[] = [];
  interpolateTo(robot, TARGET, done => {
    arrived = done;
  });
  while (arrived === undefined && frames++ < 1000) {
    tick((now_ms += 1000 * DT_S));
    const now = Float64Array.from(theLive().q_rad);
    speeds.push(
      Math.max(...now.map((q, i) => Math.abs(q - before[i]!) / DT_S / robot.arm.joints[i]!.limits.speed_rad_s)),
    );
    before = now;
  }
  fastest = Math.max(...speeds);
  expect(arrived).toBe(true);
  expect([...theLive().q_rad]).toEqual(TARGET);
  expect(fastest).toBeLessThan(0.3501);
  expect(fastest).toBeGreaterThan(0.33);
  // From rest to rest: between two frames the speed changes by no more than the cubic's largest acceleration, 6 / T².
  const largest = (6 / frames) * (0.35 / 1.5) * 1.1;
  for (const [i, speed] of speeds.entries())
    expect(Math.abs(speed - (speeds[i - 1] ?? 0))).toBeLessThan(largest + 1e-3);
});

test("a go-to that is ended stays where it is and says that it did not arrive", () => {
  let arrived: boolean | undefined;
  interpolateTo(robot, TARGET, done => {
    arrived = done;
  });
  for (let i = 0; i < 10; i++) tick((now_ms += 1000 * DT_S));
  endInterpolation();
  const stood = [...theLive().q_rad];
  for (let i = 0; i < 10; i++) tick((now_ms += 1000 * DT_S));
  expect(arrived).toBe(false);
  expect([...theLive().q_rad]).toEqual(stood);
  expect(stood).not.toEqual(TARGET);
});
