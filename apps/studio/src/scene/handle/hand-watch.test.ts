import { robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { HandWatch } from "./hand-watch.ts";

const { joints } = robotById("staubli_rx90l")!.arm;

test("L-26 L-33 a drag that turns joint 4 faster than it can is named with its speed; a resting hand has none", () => {
  const watch = new HandWatch();
  const limit = joints[3]!.limits.speed_rad_s;
  const at = (t_s: number, rad_s: number) =>
    watch.look(joints, Float64Array.of(0, 0, 0, rad_s * t_s, 0, 0), t_s * 1e4, t_s * 1000);
  expect(at(0, 0)).toBeNull();
  expect(at(0.05, 1.5 * limit)).toBeNull();
  const fast = at(0.2, 1.5 * limit)!;
  expect(fast.joint).toBe(4);
  expect(fast.share).toBeCloseTo(1.5, 9);
  // Until the next look it stays said; after a rest nothing is.
  expect(at(0.25, 1.5 * limit)).toEqual(fast);
  expect(at(5, 0)).toBeNull();
});
