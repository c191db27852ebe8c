import { flangePose } from "../kinematics/forward.ts";
import type { Reach } from "../kinematics/reach.ts";
import type { Robot } from "../robots/robot.ts";
import type { Follower } from "./follow.ts";
import { geometryScratch, linePath, posePoint } from "./geometry.ts";
import type { Move } from "./moves.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";

/** The posture a joint move ends in. */
export type Goal =
  | { readonly kind: "posture"; readonly q_rad: Float64Array }
  | { readonly kind: "none"; readonly reach: Reach };

/** Steps in which a pose is approached from the posture before. */
const STEPS = 24;

/** The posture of a move's target that is least travel away from `near`. */
export function settle(robot: Robot, follower: Follower, move: Move, near: Float64Array): Goal {
  if (move.q_rad !== undefined) return { kind: "posture", q_rad: move.q_rad };
  const line = linePath(flangePose(robot.arm, near) as Pose, move.baseFromFlange as Pose), scratch = geometryScratch();
  const q = near.slice(), goal: Pose<"base", "flange"> = identity();
  for (let k = 1; k <= STEPS; k++) {
    posePoint(line, (line.length * k) / STEPS, goal as Pose, scratch);
    if (!follower.meet(compose(goal, identity<"flange", "flange">()), q)) return { kind: "none", reach: { kind: "no-solver", because: "The pose was not met." } };
  }
  return { kind: "posture", q_rad: q };
}
