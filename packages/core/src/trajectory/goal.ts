import {
  allBranches,
  nearestSolution,
  solveAll,
  solverScratch,
  travel,
  type SolverScratch,
} from "../kinematics/inverse.ts";
import { flangePose } from "../kinematics/forward.ts";
import { branchOf, sameBranch } from "../kinematics/branch.ts";
import type { Reach } from "../kinematics/reach.ts";
import type { Robot } from "../model/robot.ts";
import { wrapAngle } from "../spatial/units.ts";
import type { Pose } from "../spatial/pose.ts";
import type { Follower } from "./follow.ts";
import { geometryScratch, linePath, posePoint } from "./geometry.ts";
import type { Move } from "./moves.ts";

/** The posture a joint move ends in. */
export type Goal =
  | { readonly kind: "posture"; readonly q_rad: Float64Array }
  /** `beyond_rad`: the posture it would be without joint limits, where there is one. */
  | { readonly kind: "none"; readonly reach: Reach; readonly beyond_rad?: Float64Array };

/** Steps in which an arm without a closed form approaches a pose from the posture before. */
const STEPS = 32;

/** Finds the postures of targets: closed form where the arm has one, following from nearby where it has none. */
export class GoalFinder {
  private readonly robot: Robot;
  private readonly follower: Follower;
  private readonly scratch: SolverScratch = solverScratch();

  constructor(robot: Robot, follower: Follower) {
    this.robot = robot;
    this.follower = follower;
  }

  /**
   * The posture of a move's target that was taught or chosen, else that with the least total travel from `near` (row
   * N-16), inside the limits.
   */
  find(move: Move, near: Float64Array): Goal {
    const told = move.q_rad ?? move.chosen_rad;
    if (told !== undefined) return { kind: "posture", q_rad: told };
    if (this.robot.family.kind === "general") return this.follow(move.baseFromFlange, near);
    const q = new Float64Array(near.length);
    if (nearestSolution(this.robot, move.baseFromFlange, near, q, this.scratch)) {
      const branch = branchOf(this.robot, q);
      if (move.branch === undefined || branch === undefined || sameBranch(branch, move.branch))
        return { kind: "posture", q_rad: q };
    }
    const reach = solveAll(
      this.robot,
      move.baseFromFlange,
      move.branch === undefined ? { near } : { near, branch: move.branch },
      this.scratch,
    );
    if (reach.kind === "reached") return { kind: "posture", q_rad: reach.solutions[0]!.q_rad };
    const beyond_rad = this.beyondLimits(move, near);
    return { kind: "none", reach, ...(beyond_rad === undefined ? {} : { beyond_rad }) };
  }

  private beyondLimits(move: Move, near: Float64Array): Float64Array | undefined {
    const all = allBranches(this.robot, move.baseFromFlange, near, this.scratch).map(q =>
      q.map((angle, j) => near[j]! + wrapAngle(angle - near[j]!)),
    );
    const wanted = all.filter(q => {
      const branch = branchOf(this.robot, q);
      return move.branch !== undefined && branch !== undefined && sameBranch(branch, move.branch);
    });
    return (wanted.length > 0 ? wanted : all).sort((a, b) => travel(a, near) - travel(b, near))[0];
  }

  private follow(goal: Pose<"base", "flange">, near: Float64Array): Goal {
    const line = linePath(flangePose(this.robot.arm, near), goal);
    const scratch = geometryScratch();
    const q = near.slice();
    const at: Pose = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
    for (let k = 1; k <= STEPS; k++) {
      posePoint(line, (line.length * k) / STEPS, at, scratch);
      if (!this.follower.meet(at as Pose<"base", "flange">, q)) {
        return {
          kind: "none",
          reach: {
            kind: "no-solver",
            because: `${this.robot.name} has no closed-form solver, and following from the posture before did not reach the pose.`,
          },
        };
      }
    }
    return { kind: "posture", q_rad: q };
  }
}
