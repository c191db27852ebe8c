import {
  PlainFault,
  explainReach,
  flangeOfTcp,
  compose,
  identity,
  robotById,
  solveAll,
  type Program,
  type Step,
} from "@twincell/core";
import type { CellDocument } from "../document.ts";

/** Far below any robot's resolution, and the same on every engine. */
const DIGITS = 1e10;

/**
 * The program with every pose replaced by the joint angles that reach it with least travel, as if each point had been
 * recorded at the robot. It then needs no cell to say where the robot stands.
 *
 * @throws {PlainFault} when a point cannot be reached.
 */
export function recordedAsJoints(cell: CellDocument, program: Program): Program {
  const robot = robotById(cell.robot.id)!;
  let near: ArrayLike<number> = robot.home_rad;
  const steps = program.steps.map((step): Step => {
    if (step.type !== "move") return step;
    const { target } = step;
    if ("q" in target) {
      near = target.q;
      return step;
    }
    const worldFromTcp = compose(program.frames[target.frame] ?? identity<"world", "frame">(), target.pose);
    const baseFromFlange = flangeOfTcp(
      cell.robot.worldFromBase,
      worldFromTcp,
      program.tools[target.tool] ?? identity(),
    );
    const reach = solveAll(
      robot,
      baseFromFlange,
      target.branch === undefined ? { near } : { near, branch: target.branch },
    );
    if (reach.kind !== "reached")
      throw new PlainFault("project.reach", `Step ${step.id}: ${explainReach(reach)}`, "Move the point.");
    near = reach.solutions[0]!.q_rad;
    return {
      ...step,
      target: { q: Array.from(near, angle => Math.round(angle * DIGITS) / DIGITS + 0), tool: target.tool },
    };
  });
  return { ...program, frames: {}, steps };
}
