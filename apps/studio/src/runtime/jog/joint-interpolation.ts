import type { Robot } from "@twincell/core";
import { onFrame } from "./jog-frames.ts";
import { showJoints, theLive } from "../live.ts";
import { leaveRobot, takeRobot } from "../robot/motion-owner.ts";

/** Part of full joint speed that a manual go-to uses. */
const PART = 0.35;
/** Peak of the cubic law over its mean: π̇(½) = 1.5. */
const PEAK = 1.5;

let stopGlide: (() => void) | null = null;
export const isGliding = (): boolean => stopGlide !== null;

/**
 * Moves the robot on screen from where it stands to q on a straight line in joint space with the cubic law
 * π(τ) = 3τ² − 2τ³; the slowest joint sets the duration. `done` tells whether it arrived or was ended before.
 */
export const interpolateTo = (robot: Robot, q_rad: ArrayLike<number>, done?: (arrived: boolean) => void): void => {
  interpolateAlong(robot, [theLive().q_rad, q_rad], done);
};

/**
 * The same along several straight lines, without stopping between them. The first posture is where the robot stands.
 */
export function interpolateAlong(
  robot: Robot,
  way: readonly ArrayLike<number>[],
  done: (arrived: boolean) => void = () => undefined,
): void {
  stopGlide?.();
  const n = theLive().q_rad.length;
  const configurations = way.map(configuration => Float64Array.from({ length: n }, (_, i) => configuration[i]!));
  // Each line takes its share of the time by its slowest joint.
  const ends_s: number[] = [];
  let whole_s = 0;
  for (let leg = 1; leg < configurations.length; leg++) {
    let leg_s = 0;
    for (let i = 0; i < n; i++)
      leg_s = Math.max(
        leg_s,
        Math.abs(configurations[leg]![i]! - configurations[leg - 1]![i]!) /
          (PART * robot.arm.joints[i]!.limits.speed_rad_s),
      );
    ends_s.push((whole_s += leg_s));
  }
  const duration_s = PEAK * whole_s;
  if (!Number.isFinite(duration_s)) {
    done(false);
    return;
  }
  const q = new Float64Array(n);
  let t_s = 0;
  let over = false;
  let leg = 0;
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
    const tau = duration_s > 0 ? Math.min(1, t_s / duration_s) : 1;
    const at_s = tau * tau * (3 - 2 * tau) * whole_s;
    while (leg < ends_s.length - 1 && at_s > ends_s[leg]!) leg++;
    const from = configurations[leg]!;
    const to = configurations[leg + 1]!;
    const begun_s = leg === 0 ? 0 : ends_s[leg - 1]!;
    const leg_s = ends_s[leg]! - begun_s;
    const part = tau >= 1 || !(leg_s > 0) ? 1 : (at_s - begun_s) / leg_s;
    for (let i = 0; i < n; i++) q[i] = from[i]! + (to[i]! - from[i]!) * part;
    showJoints(q);
    if (tau >= 1) finish(true);
  });
  stopGlide = () => finish(false);
  takeRobot("glide", stopGlide);
}
export const endInterpolation = (): void => stopGlide?.();
