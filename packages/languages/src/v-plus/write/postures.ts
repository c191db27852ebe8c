import { compose, degrees, explainReach, flangeOfTcp, identity, solveAll, type MoveStep, type Pose, type Program, type Robot, type Target } from "@twincell/core";
import { jointOutside } from "./location.ts";

/** Where the programs of a cell count from, and what they refer to. */
export interface Place {
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly tools: Program["tools"];
  readonly frames: Program["frames"];
}
type PoseTarget = Extract<Target, { readonly pose: unknown }>;
/** Joint angles by step id. */
export type PostureMap = ReadonlyMap<string, ArrayLike<number>>;
export type Postures =
  | { readonly kind: "postures"; readonly q_rad: PostureMap }
  | { readonly kind: "cannot"; readonly step: string; readonly sentence: string; readonly hint: string };

export const toolOf = ({ tools }: Place, name: string): Pose<"flange", "tcp"> => Object.hasOwn(tools, name) ? tools[name]! : identity();

export function worldFromTarget({ frames }: Place, { pose, frame }: PoseTarget): Pose<"world", "tcp"> {
  return compose(Object.hasOwn(frames, frame) ? frames[frame]! : identity<"world", "frame">(), pose);
}

/**
 * The joint angles of every taught point, by step id: those that were taught, or the ones that reach the pose with least
 * travel from the point before. Stops at the first point that cannot be reached or lies outside the limits.
 */
export function posturesOf(moves: readonly MoveStep[], place: Place): Postures {
  const { robot, worldFromBase } = place;
  const q_rad = new Map<string, ArrayLike<number>>();
  let near: ArrayLike<number> = robot.home_rad;
  for (const { id, name, target } of moves) {
    const called = `Step ${name ?? id}`;
    if ("q" in target) {
      if (target.q.length !== robot.arm.joints.length) {
        return { kind: "cannot", step: id, sentence: `${called} holds ${target.q.length} joint angles; the ${robot.name} has ${robot.arm.joints.length} joints.`, hint: "Teach the step again on this robot." };
      }
      near = target.q;
    } else {
      const { branch } = target;
      const baseFromFlange = flangeOfTcp(worldFromBase, worldFromTarget(place, target), toolOf(place, target.tool));
      const reach = solveAll(robot, baseFromFlange, branch === undefined ? { near } : { near, branch });
      if (reach.kind !== "reached") {
        return { kind: "cannot", step: id, sentence: `${called} cannot be reached. ${explainReach(reach)}`, hint: "Check the program: it says what would bring the step into reach." };
      }
      near = reach.solutions[0]!.q_rad;
    }
    const outside = jointOutside(robot, near);
    if (outside !== undefined) {
      const { joint, limits } = outside;
      return {
        kind: "cannot", step: id,
        sentence: `${called} turns joint ${joint} to ${degrees(near[joint - 1]!).toFixed(2)}°; it may turn from ${degrees(limits.lower_rad).toFixed(1)}° to ${degrees(limits.upper_rad).toFixed(1)}°.`,
        hint: "Move the point, or choose another branch for it.",
      };
    }
    q_rad.set(id, near);
  }
  return { kind: "postures", q_rad };
}
