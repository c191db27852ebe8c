import type { ManualScheduler, RealController } from "@twincell/core";
import { expect } from "vitest";
import type { VirtualController } from "../virtual/index.ts";

export interface SilentBench {
  readonly scheduler: ManualScheduler;
  readonly real: RealController;
  readonly arm: Pick<VirtualController, "jointAngles">;
  /** Of the controller: it takes what comes and answers nothing. */
  readonly faults: { silent: boolean };
  readonly ended: <T>(command: Promise<T>) => Promise<T>;
}
/**
 * Rows T-46 and T-47: a controller that does not answer any more holds nothing up here, the stop goes out all the same, and the
 * connection comes back.
 *
 * @param far_rad  a target so far that the robot is still on its way after `after_s`.
 */
export async function silenceHoldsNothingUp({ scheduler, real, arm, faults, ended }: SilentBench, far_rad: readonly number[], after_s: number): Promise<void> {
  const moving = real.moveJoints(far_rad);
  await scheduler.elapse(after_s);
  faults.silent = true;
  const from_s = scheduler.now_s();
  real.stop();
  expect(scheduler.now_s()).toBe(from_s);
  expect((await ended(moving)).kind).toBe("stopped");
  expect(Math.max(...Array.from(arm.jointAngles(), (q, i) => Math.abs(q - far_rad[i]!)))).toBeGreaterThan(0.1);
  faults.silent = false;
  await scheduler.elapse(12);
  expect(real.isConnected).toBe(true);
}
