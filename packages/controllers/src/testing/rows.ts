import type { ManualScheduler, RealController } from "@twincell/core";
import { expect } from "vitest";
import { createTwin } from "../twin/index.ts";
import type { VirtualController } from "../virtual/index.ts";

/** A driver that is connected to its virtual controller. */
export interface Driven {
  readonly scheduler: ManualScheduler;
  readonly real: RealController;
  readonly arm: Pick<VirtualController, "jointAngles">;
  readonly ended: <T>(command: Promise<T>) => Promise<T>;
}
/** A stop at moderate speed: its way over the line and the braking of the slowest of the arms [s]. */
const STOPPED_WITHIN_S = 0.5;
const ACCURACY_RAD = (0.001 * Math.PI) / 180;
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));

/**
 * Rows T-23, T-24 and T-25: commanded, measured and mirrored angles agree to 0.001°, and the robot is commanded before
 * the twin moves.
 */
export async function twinAgrees(
  { scheduler, real, arm, ended }: Driven,
  shifted: (by_rad: number) => readonly number[],
): Promise<void> {
  const twin = createTwin({ real, scheduler });
  for (const by of [0.4, -0.3, 0.123456]) {
    expect(await ended(twin.moveJoints(shifted(by)))).toEqual({ kind: "done" });
    for (const is of [arm.jointAngles(), real.jointAngles()])
      expect(farthest(is, shifted(by))).toBeLessThanOrEqual(ACCURACY_RAD);
  }
  expect(twin.accuracy.mirror_rad).toBeLessThanOrEqual(ACCURACY_RAD);
  expect(twin.accuracy.command_rad).toBeLessThanOrEqual(ACCURACY_RAD);
  const command = twin.log.find(({ what }) => what === "command")!;
  const pose = twin.log.find(({ what }) => what === "pose")!;
  expect(command.at_s).toBeLessThan(pose.at_s);
}

/**
 * Rows T-46 and T-47: a controller that does not answer any more holds nothing up here, the stop goes out all the same,
 * and the connection comes back.
 *
 * @param faults   of the controller: silent, it takes what comes and answers nothing.
 * @param far_rad  a target so far that the robot is still on its way after `after_s`.
 */
export async function silenceHoldsNothingUp(
  { scheduler, real, arm, faults, ended }: Driven & { readonly faults: { silent: boolean } },
  far_rad: readonly number[],
  after_s: number,
): Promise<void> {
  const moving = real.moveJoints(far_rad);
  await scheduler.elapse(after_s);
  faults.silent = true;
  real.stop();
  // Still silent: the stop alone brings the arm to rest, on its way, within the braking time and the watchdog's least.
  await scheduler.elapse(STOPPED_WITHIN_S);
  const rest_rad = Float64Array.from(arm.jointAngles());
  await scheduler.elapse(1);
  expect(farthest(arm.jointAngles(), rest_rad)).toBe(0);
  expect(farthest(rest_rad, far_rad)).toBeGreaterThan(0.1);
  expect((await ended(moving)).kind).toBe("stopped");
  faults.silent = false;
  await scheduler.elapse(12);
  expect(real.isConnected).toBe(true);
}
