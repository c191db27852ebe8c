import type { Robot } from "@twincell/core";
import { onFrame } from "./frames.ts";
import { showJoints, theLive } from "./live.ts";
import { leaveRobot, takeRobot } from "./owner.ts";

/** Part of full joint speed that a manual go-to uses. */
const PART = 0.35;
/** Peak of the cubic law over its mean: π̇(½) = 1.5. */
const PEAK = 1.5;

let stopGlide: (() => void) | null = null;

/**
 * Moves the robot on screen from where it stands to q on a straight line in joint space with the cubic law
 * π(τ) = 3τ² − 2τ³; the slowest joint sets the duration. `done` tells whether it arrived or was ended before.
 */
export function glideTo(robot: Robot, q_rad: ArrayLike<number>, done: (arrived: boolean) => void = () => undefined): void {
  stopGlide?.();
  const from = Float64Array.from(theLive().q_rad), to = Float64Array.from({ length: from.length }, (_, i) => q_rad[i]!);
  let duration_s = 0;
  for (let i = 0; i < from.length; i++) {
    duration_s = Math.max(duration_s, (PEAK * Math.abs(to[i]! - from[i]!)) / (PART * robot.arm.joints[i]!.limits.speed_rad_s));
  }
  if (!Number.isFinite(duration_s)) { done(false); return; }
  const q = new Float64Array(from.length);
  let t_s = 0, over = false;
  const finish = (arrived: boolean): void => {
    if (over) return;
    over = true;
    leave();
    stopGlide = null;
    leaveRobot("glide");
    done(arrived);
  };
  const leave = onFrame((_now, dt_s) => {
    t_s += dt_s;
    const tau = duration_s > 0 ? Math.min(1, t_s / duration_s) : 1, part = tau * tau * (3 - 2 * tau);
    for (let i = 0; i < q.length; i++) q[i] = from[i]! + (to[i]! - from[i]!) * part;
    showJoints(q);
    if (tau >= 1) finish(true);
  });
  stopGlide = () => finish(false);
  takeRobot("glide", stopGlide);
}
export const endGlide = (): void => stopGlide?.();
