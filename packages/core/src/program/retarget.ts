import { flangePose } from "../kinematics/forward.ts";
import { flangeOfTcp, nearestSolution, solverScratch } from "../kinematics/inverse.ts";
import { isInsideWorkspace } from "../kinematics/workspace.ts";
import type { Robot } from "../model/robot.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import type { MoveStep, Program, Step, Target } from "./program.ts";
import { withLists } from "./walk.ts";

/** A program for another robot, and what became of its points. */
export interface Retargeted {
  readonly program: Program;
  /** Targets and points on the way that moves have. */
  readonly points: number;
  /** Steps with a point that the new robot does not reach; the checker says why. */
  readonly unreached: readonly string[];
}

/** Joint angles this close are the home position [rad]. */
const SAME_RAD = 1e-6;

/**
 * The same work done by another robot at the same place. Home stays home; every other point keeps where the tool tip
 * is:
 *
 *   worldFromTcp = worldFromBase · baseFromFlange(from, q) · flangeFromTcp
 *
 * A point taught as joint angles becomes the new robot's angles, nearest to those of the point before; one that it
 * does not reach becomes that pose in the world, so that nothing is lost. Poses lose the branch, which names a posture
 * of the old arm. Steps inside blocks and routines as well.
 *
 * @param from  the robot the program was taught on. @param to  the robot that shall do it.
 * @param worldFromBase     where the new robot stands.
 * @param worldFromOldBase  where the old one stood, when that was elsewhere.
 */
export function retargetProgram(
  program: Program,
  from: Robot,
  to: Robot,
  worldFromBase: Pose<"world", "base">,
  worldFromOldBase: Pose<"world", "base"> = worldFromBase,
): Retargeted {
  const scratch = solverScratch();
  const near = Float64Array.from(to.home_rad);
  const unreached = new Set<string>();
  let points = 0;

  /** Whether the new robot brings the tip there; then `near` is how. */
  const reaches = (worldFromTcp: Pose<"world", "tcp">, tool: string): boolean => {
    const q = new Float64Array(near.length);
    if (
      !nearestSolution(to, flangeOfTcp(worldFromBase, worldFromTcp, toolOf(program, tool)), near, q, scratch) ||
      !isInsideWorkspace(to, q)
    )
      return false;
    near.set(q);
    return true;
  };

  const moved = (target: Target, step: string): Target => {
    points++;
    if (!("q" in target)) {
      const worldFromFrame = target.frame === "world" ? identity<"world", "frame">() : program.frames[target.frame];
      // Places of a pallet are many: each is judged by the checker.
      if (
        worldFromFrame !== undefined &&
        !Object.hasOwn(program.pallets, target.frame) &&
        !reaches(compose(worldFromFrame, target.pose), target.tool)
      )
        unreached.add(step);
      return { pose: target.pose, frame: target.frame, tool: target.tool };
    }
    const withTool = target.tool === undefined ? {} : { tool: target.tool };
    if (from.home_rad.every((home, j) => Math.abs(home - (target.q[j] ?? Infinity)) <= SAME_RAD)) {
      near.set(to.home_rad);
      return { q: [...to.home_rad], ...withTool };
    }
    const tool = target.tool ?? "flange";
    const worldFromTcp = compose(compose(worldFromOldBase, flangePose(from.arm, target.q)), toolOf(program, tool));
    if (reaches(worldFromTcp, tool)) return { q: Array.from(near), ...withTool };
    unreached.add(step);
    return { pose: { position: worldFromTcp.position, quaternion: worldFromTcp.quaternion }, frame: "world", tool };
  };

  const list = (steps: readonly Step[]): readonly Step[] =>
    steps.map((step): Step => (step.type === "move" ? movedStep(step) : withLists(step, list)));
  const movedStep = (step: MoveStep): MoveStep => {
    // The point on the way comes first.
    const via = step.via === undefined ? undefined : moved(step.via, step.id);
    const target = moved(step.target, step.id);
    return via === undefined ? { ...step, target } : { ...step, via, target };
  };

  if (from.id === to.id)
    return { program: program.robot === to.id ? program : { ...program, robot: to.id }, points: 0, unreached: [] };
  const steps = list(program.steps);
  const routines = Object.fromEntries(Object.entries(program.routines).map(([name, inside]) => [name, list(inside)]));
  return { program: { ...program, robot: to.id, steps, routines }, points, unreached: [...unreached] };
}

const toolOf = ({ tools }: Program, name: string): Pose<"flange", "tcp"> =>
  Object.hasOwn(tools, name) ? tools[name]! : identity();
