import {
  branchOf,
  compose,
  degrees,
  explainReach,
  flangeOfTcp,
  flow,
  identity,
  solveAll,
  withLists,
  type Branch,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  type Step,
  type Target,
} from "@twincell/core";
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
export type ConfigurationMap = ReadonlyMap<string, ArrayLike<number>>;
export type Configurations =
  | { readonly kind: "postures"; readonly q_rad: ConfigurationMap }
  | { readonly kind: "cannot"; readonly step: string; readonly sentence: string; readonly hint: string };

export const toolOf = ({ tools }: Place, name: string): Pose<"flange", "tcp"> =>
  Object.hasOwn(tools, name) ? tools[name]! : identity();

export function worldFromTarget({ frames }: Place, { pose, frame }: PoseTarget): Pose<"world", "tcp"> {
  return compose(Object.hasOwn(frames, frame) ? frames[frame]! : identity<"world", "frame">(), pose);
}

/**
 * The joint angles of every taught point, by step id: those that were taught, or the ones that reach the pose with
 * least travel from the point before. A point that is visited at many places has the angles of the first; the text says
 * one posture for all of them, so each must be reached in it. Stops at the first point that cannot be reached or lies
 * outside the limits.
 */
export function configurationsOf(program: Program, place: Place): Configurations {
  const q_rad = new Map<string, ArrayLike<number>>();
  let near: ArrayLike<number> = place.robot.home_rad;
  // Routines that nobody calls are written all the same.
  for (const steps of [program.steps, ...Object.values(program.routines)]) {
    for (const happening of flow(
      {
        ...program,
        steps: once(steps),
        routines: Object.fromEntries(Object.entries(program.routines).map(([name, list]) => [name, once(list)])),
      },
      { rounds: 1 },
    )) {
      if (happening.kind !== "step" || happening.step.type !== "move") continue;
      const { step, visits } = happening;
      const known = q_rad.get(step.id);
      if (known !== undefined && visits.length === 0) {
        near = known;
        continue;
      }
      const configuration = postureOf(
        step,
        place,
        known ?? near,
        known === undefined ? undefined : branchOf(place.robot, known),
      );
      if (configuration.kind === "cannot")
        return visits.length === 0
          ? configuration
          : {
              ...configuration,
              sentence: `Place ${visits.map(({ number, of }) => `${number} of ${of}`).join(", ")}: ${configuration.sentence}`,
            };
      near = configuration.q_rad;
      if (known === undefined) q_rad.set(step.id, near);
    }
  }
  return { kind: "postures", q_rad };
}

/** Loops go round once: every round goes to the same points. Whatever a program computes, every way is looked at. */
const once = (steps: readonly Step[]): readonly Step[] => steps.map(step => withLists(anyWay(step), once));

function anyWay(step: Step): Step {
  const when = { signal: "", is: true };
  switch (step.type) {
    case "repeat":
      return { ...step, times: 1 };
    case "if":
    case "wait-for":
      return { ...step, when };
    case "while":
      return { id: step.id, type: "repeat", times: 1, steps: step.steps };
    default:
      return step;
  }
}

/** @param inBranch  the posture that the text has said already. */
function postureOf(
  { id, name, target }: MoveStep,
  place: Place,
  near: ArrayLike<number>,
  inBranch: Branch | undefined,
): { readonly kind: "posture"; readonly q_rad: ArrayLike<number> } | Extract<Configurations, { kind: "cannot" }> {
  const { robot, worldFromBase } = place;
  const called = `Step ${name ?? id}`;
  let q_rad: ArrayLike<number>;
  if ("q" in target) {
    if (target.q.length !== robot.arm.joints.length) {
      return {
        kind: "cannot",
        step: id,
        sentence: `${called} holds ${target.q.length} joint angles; the ${robot.name} has ${robot.arm.joints.length} joints.`,
        hint: "Teach the step again on this robot.",
      };
    }
    q_rad = target.q;
  } else {
    const branch = target.branch ?? inBranch;
    const baseFromFlange = flangeOfTcp(worldFromBase, worldFromTarget(place, target), toolOf(place, target.tool));
    const reach = solveAll(robot, baseFromFlange, branch === undefined ? { near } : { near, branch });
    if (reach.kind !== "reached") {
      return {
        kind: "cannot",
        step: id,
        sentence: `${called} cannot be reached. ${explainReach(reach)}`,
        hint: "Check the program: it says what would bring the step into reach.",
      };
    }
    q_rad = reach.solutions[0]!.q_rad;
  }
  const outside = jointOutside(robot, q_rad);
  if (outside === undefined) return { kind: "posture", q_rad };
  const { joint, limits } = outside;
  return {
    kind: "cannot",
    step: id,
    sentence: `${called} turns joint ${joint} to ${degrees(q_rad[joint - 1]!).toFixed(2)}°; it may turn from ${degrees(limits.lower_rad).toFixed(1)}° to ${degrees(limits.upper_rad).toFixed(1)}°.`,
    hint: "Move the point, or choose another branch for it.",
  };
}
