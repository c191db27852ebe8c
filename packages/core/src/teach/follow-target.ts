import { explainReach } from "../kinematics/explain.ts";
import { flangePose } from "../kinematics/forward.ts";
import { flangeOfTcp, nearestSolution, solveAll, solverScratch, type SolverScratch } from "../kinematics/inverse.ts";
import {
  dampedScratch,
  explainNumeric,
  nearestDamped,
  solveDamped,
  type DampedScratch,
} from "../kinematics/numeric/damped.ts";
import { lengthAt, poseError } from "../kinematics/numeric/pose-error.ts";
import type { Robot } from "../model/robot.ts";
import { identity, type Pose } from "../spatial/pose.ts";
import { speedLoad, type JogCell } from "./jog-cell.ts";

/** Working memory of `followTarget`: one per robot and target. */
export interface FollowScratch {
  readonly solver: SolverScratch;
  readonly damped: DampedScratch;
  readonly goal: Float64Array;
  readonly error: Float64Array;
  readonly wanted: Pose<"base", "flange">;
  readonly reached: Pose<"base", "flange">;
}
export const followScratch = (robot: Robot): FollowScratch => {
  const n = robot.arm.joints.length;
  return {
    solver: solverScratch(),
    damped: dampedScratch(n),
    goal: new Float64Array(n),
    error: new Float64Array(6),
    wanted: identity(),
    reached: identity(),
  };
};

/** How one frame of following ended: what is left to the target, and why where more frames will not help. */
export type Followed =
  | { readonly kind: "on-target" }
  /** The joints are on their way as fast as they may; joint (from 1) is the one that sets the pace. */
  | { readonly kind: "behind"; readonly joint: number; readonly position_m: number; readonly angle_rad: number }
  /** The arm stands, or is on its way to, where it comes nearest. */
  | {
      readonly kind: "out-of-reach";
      readonly position_m: number;
      readonly angle_rad: number;
      readonly sentence: string;
    };

/**
 * One frame of an arm that follows a moving target with its tool tip (rows X-18, L-25): inverse kinematics anew,
 * nearest to where the arm stands and inside its limits, then as far as the joint speeds allow, all joints in
 * proportion.
 *
 *   q′ = q + min(1, 1 / max_j |q*_j − q_j| / (v_j dt)) (q* − q)
 *
 * The closed form where the arm has one, else damped least squares. A target out of reach is approached as near as can
 * be.
 *
 * @param q     joint angles [rad] the arm stands at. Read only.
 * @param dt_s  duration of the frame; over 0.
 * @param out   receives the new angles. May be `q`.
 */
export function followTarget(
  cell: JogCell,
  worldFromTarget: Pose<"world", "tcp">,
  q: ArrayLike<number>,
  dt_s: number,
  out: Float64Array,
  scratch: FollowScratch,
): Followed {
  const { robot } = cell;
  const { goal, wanted, damped, error } = scratch;
  flangeOfTcp(cell.worldFromBase, worldFromTarget, cell.flangeFromTcp, wanted);
  for (let j = 0; j < goal.length; j++) out[j] = q[j]!;
  let sentence: string | undefined;
  if (
    !nearestSolution(robot, wanted, out, goal, scratch.solver) &&
    !nearestDamped(robot.arm, wanted, out, goal, damped)
  ) {
    const nearest = solveDamped(robot.arm, wanted, out, {}, damped);
    if (nearest.kind === "not-a-pose")
      return { kind: "out-of-reach", position_m: NaN, angle_rad: NaN, sentence: nearest.because };
    const reach = solveAll(robot, wanted);
    sentence = reach.kind === "reached" || reach.kind === "no-solver" ? explainNumeric(nearest) : explainReach(reach);
    goal.set(nearest.q_rad);
  }
  const load = speedLoad(robot, out, goal, dt_s);
  const share = load > 1 ? 1 / load : 1;
  let slowest = 0;
  let most = -1;
  for (let j = 0; j < goal.length; j++) {
    const travel = Math.abs(goal[j]! - out[j]!) / robot.arm.joints[j]!.limits.speed_rad_s;
    if (travel > most) {
      most = travel;
      slowest = j + 1;
    }
    out[j]! += share * (goal[j]! - out[j]!);
  }
  if (share === 1 && sentence === undefined) return { kind: "on-target" };
  poseError(wanted, flangePose(robot.arm, out, scratch.reached, scratch.solver.arm), error);
  const position_m = lengthAt(error, 0);
  const angle_rad = lengthAt(error, 3);
  return sentence === undefined
    ? { kind: "behind", joint: slowest, position_m, angle_rad }
    : { kind: "out-of-reach", position_m, angle_rad, sentence };
}
