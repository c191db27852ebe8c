import type { DeclaredWorkspace, Robot } from "../model/robot.ts";
import { identity, transformPoint, type Pose } from "../spatial/pose.ts";
import { rotate } from "../spatial/quaternion.ts";
import { cross, norm, subtract, type Vector3 } from "../spatial/vector.ts";
import { armScratch, chainOf, walk, type ArmScratch } from "./chain.ts";
import type { Reach, Solution } from "./reach.ts";

/** Rounding that a pose at the very edge may carry [m]. */
const SLACK_M = 1e-9;

/** Working memory of `reachOfConfiguration`, for an arm of that many joints. */
export interface WorkspaceScratch {
  readonly arm: ArmScratch;
  readonly links: Pose<"base", "link">[];
  readonly flange: Pose<"base", "flange">;
}
export const workspaceScratch = (joints: number): WorkspaceScratch => ({
  arm: armScratch(),
  links: Array.from({ length: joints + 1 }, () => identity<"base", "link">()),
  flange: identity(),
});

/**
 * Distance of the wrist centre from axis 2 [m]: what a declared reach is measured by. The wrist of a UR stands aside of
 * the shoulder's plane; that step is along axis 2 and does not count.
 */
export function reachOfConfiguration(
  robot: Robot,
  { wristInFlange_m }: DeclaredWorkspace,
  q_rad: ArrayLike<number>,
  scratch = workspaceScratch(robot.arm.joints.length),
): number {
  const { arm, links, flange } = scratch;
  walk(chainOf(robot.arm, q_rad, arm), q_rad, flange, links, null);
  const shoulder = links[2]!;
  const wrist: Vector3 = transformPoint(flange, wristInFlange_m);
  return norm(cross(subtract(wrist, shoulder.position), rotate(shoulder.quaternion, robot.arm.joints[1]!.axis)));
}

/** Whether joint angles keep to the declared workspace; true where none is declared. */
export const isInsideWorkspace = (robot: Robot, q_rad: ArrayLike<number>, scratch?: WorkspaceScratch): boolean =>
  robot.workspace === undefined ||
  reachOfConfiguration(robot, robot.workspace, q_rad, scratch) <= robot.workspace.reach_m + SLACK_M;

/**
 * Row X-08: the solutions inside the workspace that the maker declares. The links may reach farther than that: then the
 * answer is another one than "too far".
 */
export function insideWorkspace(
  robot: Robot,
  solutions: readonly Solution[],
): readonly Solution[] | Extract<Reach, { kind: "beyond-workspace" }> {
  const { workspace } = robot;
  if (workspace === undefined || solutions.length === 0) return solutions;
  const scratch = workspaceScratch(robot.arm.joints.length);
  let least_m = Infinity;
  const inside = solutions.filter(({ q_rad }) => {
    const distance_m = reachOfConfiguration(robot, workspace, q_rad, scratch);
    least_m = Math.min(least_m, distance_m);
    return distance_m <= workspace.reach_m + SLACK_M;
  });
  return inside.length > 0 ? inside : { kind: "beyond-workspace", distance_m: least_m, declared_m: workspace.reach_m };
}
