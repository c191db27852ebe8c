import { branchOf } from "../kinematics/branch.ts";
import { flangePose } from "../kinematics/forward.ts";
import { nearestSolution } from "../kinematics/inverse.ts";
import type { Robot } from "../model/robot.ts";
import type { Program, Target } from "../program/program.ts";
import { compose, identity, inverse, type Pose } from "../spatial/pose.ts";
import { slerp } from "../spatial/quaternion.ts";
import { distance, lerp, type Vector3 } from "../spatial/vector.ts";

/** A taught point that the tool may snap to. */
export interface SnapPoint {
  readonly id: string;
  readonly worldFromTcp: Pose<"world", "tcp">;
  /** Its step cannot be carried out: such points come first. */
  readonly bad: boolean;
}
export type Snap =
  | { readonly kind: "snapped"; readonly point: SnapPoint; readonly distance_m: number }
  | { readonly kind: "too-far"; readonly point: SnapPoint; readonly distance_m: number }
  | { readonly kind: "none" };

/** The point that a tool tip snaps to (row L-42): the nearest bad one within the radius, else the nearest of all. */
export function snapPoint(points: readonly SnapPoint[], tip_m: Vector3, radius_m: number): Snap {
  let best: SnapPoint | undefined;
  let best_m = Infinity;
  let preferred = false;
  for (const point of points) {
    const away_m = distance(point.worldFromTcp.position, tip_m);
    const prefers = point.bad && away_m <= radius_m;
    if (prefers === preferred ? away_m >= best_m : preferred) continue;
    best = point;
    best_m = away_m;
    preferred = prefers;
  }
  if (best === undefined) return { kind: "none" };
  return { kind: best_m <= radius_m ? "snapped" : "too-far", point: best, distance_m: best_m };
}

/** Halvings of the way to a pose that cannot be reached. */
const HALVINGS = 14;

/**
 * The posture nearest to `near` that brings the flange to a pose, or as far towards it on a straight line as the robot
 * can.
 *
 * @param near  where the robot stands [rad; m where it slides].
 * @returns a new array, and how far from the pose the flange is then [m]; 0 where it is there.
 */
export function nearestTo(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  near: ArrayLike<number>,
): { readonly q_rad: Float64Array; readonly short_m: number } {
  const q = Float64Array.from(near);
  if (nearestSolution(robot, baseFromFlange, near, q)) return { q_rad: q, short_m: 0 };
  const from = flangePose(robot.arm, near);
  const best = Float64Array.from(near);
  const at = identity<"base", "flange">();
  let [low, high] = [0, 1];
  for (let i = 0; i < HALVINGS; i++) {
    const share = (low + high) / 2;
    lerp(from.position, baseFromFlange.position, share, at.position);
    slerp(from.quaternion, baseFromFlange.quaternion, share, at.quaternion);
    if (nearestSolution(robot, at, best, q)) {
      best.set(q);
      low = share;
    } else high = share;
  }
  return { q_rad: best, short_m: distance(flangePose(robot.arm, best).position, baseFromFlange.position) };
}

/**
 * A target taught again where the robot stands: in the frame, with the tool and in the form it had; a branch that was
 * asked for becomes the one the robot is in.
 */
export function taughtAgain(
  target: Target,
  robot: Robot,
  q_rad: ArrayLike<number>,
  { frames, tools }: Pick<Program, "frames" | "tools">,
  worldFromBase: Pose<"world", "base">,
): Target {
  if ("q" in target) return { ...target, q: Array.from(q_rad) };
  const worldFromFrame = frames[target.frame] ?? identity<"world", "frame">();
  const flangeFromTcp = tools[target.tool] ?? identity<"flange", "tcp">();
  const worldFromTcp = compose(compose(worldFromBase, flangePose(robot.arm, q_rad)), flangeFromTcp);
  const branch = target.branch === undefined ? undefined : branchOf(robot, q_rad);
  return {
    ...target,
    pose: compose(inverse(worldFromFrame), worldFromTcp),
    ...(branch === undefined ? {} : { branch }),
  };
}
