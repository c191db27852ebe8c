import { flangePose } from "../kinematics/forward.ts";
import { solveAll } from "../kinematics/inverse.ts";
import type { Robot } from "../model/robot.ts";
import { compose, inverse, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, rotate, type Quaternion } from "../spatial/quaternion.ts";
import { addScaled, type Vector3 } from "../spatial/vector.ts";

/** Directions of a Cartesian jog: along x, y, z, then about them. */
export type CartesianAxis = 0 | 1 | 2 | 3 | 4 | 5;
/** Axes of their own, seen from the base; turns are about the tool centre point. */
export interface JogAxes {
  readonly baseFromAxes: Quaternion;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
}
/** Whose axes those are: the base's, or the flange's as it stands when the jog begins, about the flange; or others. */
export type JogTargetFrame = "base" | "flange" | JogAxes;

/**
 * A jog key held for long ends this far inside a joint limit [rad], so that rounding in a controller does not refuse
 * it.
 */
const INSIDE_LIMIT_RAD = 1e-3;
/** A held Cartesian jog goes no farther than this in one press [m, rad]. */
const MAX_TRAVEL_M = 0.5;
const MAX_TURN_RAD = Math.PI / 2;
/** Its straight line is looked at in these steps [m, rad]. */
const STEP_M = 0.005;
const STEP_RAD = Math.PI / 180;
/** A joint that turns more than this in one of them is near a singularity, or on another solution [rad]. */
const MAX_JOINT_STEP_RAD = 0.15;

/**
 * Joint angles with one joint moved by an angle, kept inside its limits. Joints count from 1.
 *
 *   q'_j = clamp(q_j + by, lower_j + ε, upper_j − ε),   ε = 0.001 rad;   never against the direction of `by`
 *
 * @param by_rad  ±Infinity for the whole way to the limit.
 */
export function jointTarget(robot: Robot, q_rad: ArrayLike<number>, joint: number, by_rad: number): number[] {
  const target_rad = Array.from(q_rad);
  const { lower_rad, upper_rad } = robot.arm.joints[joint - 1]!.limits;
  const now_rad = target_rad[joint - 1]!;
  const wanted_rad = now_rad + by_rad;
  target_rad[joint - 1] =
    by_rad > 0
      ? Math.max(now_rad, Math.min(wanted_rad, upper_rad - INSIDE_LIMIT_RAD))
      : Math.min(now_rad, Math.max(wanted_rad, lower_rad + INSIDE_LIMIT_RAD));
  return target_rad;
}

/**
 * The flange moved along an axis, or turned about one through its own origin.
 *
 *   base:    p' = p + d·e,         R' = Rot(e, d)·R
 *   flange:  p' = p + d·(R·e),     R' = R·Rot(e, d)
 *   others:  as base with e turned into the base, for the tool centre point instead of the flange
 */
export function shiftFlange(
  baseFromFlange: Pose<"base", "flange">,
  axis: CartesianAxis,
  by: number,
  frame: JogTargetFrame,
): Pose<"base", "flange"> {
  const unit: Vector3 = [0, 0, 0];
  unit[axis % 3] = 1;
  if (typeof frame === "object") {
    const baseFromTcp = compose(baseFromFlange, frame.flangeFromTcp);
    const along = rotate(frame.baseFromAxes, unit);
    const moved: Pose<"base", "tcp"> =
      axis < 3
        ? { ...baseFromTcp, position: addScaled(baseFromTcp.position, along, by) }
        : { ...baseFromTcp, quaternion: multiply(fromAxisAngle(along, by), baseFromTcp.quaternion) };
    return compose(moved, inverse(frame.flangeFromTcp));
  }
  const { position, quaternion } = baseFromFlange;
  if (axis < 3) {
    const along = frame === "base" ? unit : rotate(quaternion, unit);
    return { position: addScaled(position, along, by), quaternion: [...quaternion] };
  }
  const turn = fromAxisAngle(unit, by);
  return {
    position: [...position],
    quaternion: frame === "base" ? multiply(turn, quaternion) : multiply(quaternion, turn),
  };
}

/** A joint jog is looked at in steps of at most this [rad]. */
const JOINT_STEP_RAD = (0.5 * Math.PI) / 180;

/**
 * The postures on the way of one joint by an angle, as `jointTarget` limits it; the last is the target, where it stands
 * is not among them.
 */
export function jointWay(robot: Robot, q_rad: ArrayLike<number>, joint: number, by_rad: number): number[][] {
  const from = Array.from(q_rad);
  const to_rad = jointTarget(robot, q_rad, joint, by_rad)[joint - 1]!;
  const now_rad = from[joint - 1]!;
  const count = Math.ceil(Math.abs(to_rad - now_rad) / JOINT_STEP_RAD);
  return Array.from({ length: count }, (_, i) =>
    from.with(joint - 1, i + 1 === count ? to_rad : now_rad + ((to_rad - now_rad) * (i + 1)) / count),
  );
}

/**
 * The postures on a straight jog of the flange, as far as the arm goes without a jump of a joint; the last is its end,
 * where it stands is not among them.
 *
 * @param by  [m] along x, y, z; [rad] about them. ±Infinity for as far as one held press may go.
 * @param whole  Only the whole distance counts: a step is done or not done, and empty then.
 */
export function cartesianWay(
  robot: Robot,
  q_rad: ArrayLike<number>,
  axis: CartesianAxis,
  by: number,
  frame: JogTargetFrame,
  whole = Number.isFinite(by),
): number[][] {
  const travel = Number.isFinite(by) ? by : Math.sign(by) * (axis < 3 ? MAX_TRAVEL_M : MAX_TURN_RAD);
  const count = Math.max(1, Math.ceil(Math.abs(travel) / (axis < 3 ? STEP_M : STEP_RAD)));
  const from = flangePose(robot.arm, q_rad);
  const way: number[][] = [];
  let last = Array.from(q_rad);
  for (let i = 1; i <= count; i++) {
    const reach = solveAll(robot, shiftFlange(from, axis, (travel * i) / count, frame), { near: last });
    const next = reach.kind === "reached" ? reach.solutions[0]?.q_rad : undefined;
    if (!next || last.some((angle, j) => Math.abs(next[j]! - angle) > MAX_JOINT_STEP_RAD)) return whole ? [] : way;
    last = Array.from(next);
    way.push(last);
  }
  return way;
}

/** Joint angles at the end of that way; null when it goes nowhere. */
export const cartesianTarget = (...asked: Parameters<typeof cartesianWay>): number[] | null =>
  cartesianWay(...asked).at(-1) ?? null;
