import {
  compose,
  explainReach,
  flangeOfTcp,
  identity,
  solveAll,
  type MoveStep,
  type Pose,
  type Reach,
} from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { flangeFromTcpOf, programOf, robotOf } from "../../stores/document.ts";

export type Solved =
  | { readonly kind: "reached"; readonly q_rad: Float64Array }
  | { readonly kind: "not"; readonly reach: Reach; readonly sentence: string };

/** Joint angles that bring the tool tip there, nearest to `near`; or why not. */
export function solveTcp(
  worldFromTcp: Pose<"world", "tcp">,
  near: ArrayLike<number>,
  flangeFromTcp = flangeFromTcpOf(cellStore.getState().document),
): Solved {
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  if (!document || !robot)
    return {
      kind: "not",
      reach: { kind: "no-solver", because: "There is no robot in the cell." },
      sentence: "There is no robot in the cell.",
    };
  const reach = solveAll(robot, flangeOfTcp(document.robot.worldFromBase, worldFromTcp, flangeFromTcp), { near });
  const first = reach.kind === "reached" ? reach.solutions[0] : undefined;
  return first ? { kind: "reached", q_rad: first.q_rad } : { kind: "not", reach, sentence: explainReach(reach) };
}

/** Joint angles of a step's target. */
export function solveStep(step: MoveStep, near: ArrayLike<number>): Solved {
  const { target } = step;
  if ("q" in target) return { kind: "reached", q_rad: Float64Array.from(target.q) };
  const program = programOf(cellStore.getState().document);
  const worldFromFrame = program?.frames[target.frame] ?? identity<"world", "frame">();
  const flangeFromTcp = program?.tools[target.tool] ?? identity<"flange", "tcp">();
  return solveTcp(compose(worldFromFrame, target.pose), near, flangeFromTcp);
}
