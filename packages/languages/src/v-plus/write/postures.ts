import { branchOf, flangeOfTcp, flow, withLists, type Branch, type MoveStep, type Step } from "@twincell/core";
import {
  flangeReached,
  numberedJoint,
  otherArm,
  outsideLimits,
  type Cannot,
  type Reached,
  type WalkedPlace,
} from "../../emitter/index.ts";

/** Joint angles by step id. */
export type ConfigurationMap = ReadonlyMap<string, ArrayLike<number>>;
export type Configurations = { readonly kind: "postures"; readonly q_rad: ConfigurationMap } | Cannot;

/**
 * The joint angles of every taught point, by step id: those that were taught, or the ones that reach the pose with
 * least travel from the point before. A point that is visited at many places has the angles of the first; the text says
 * one posture for all of them, so each must be reached in it. Stops at the first point that cannot be reached or lies
 * outside the limits.
 */
export function configurationsOf(place: WalkedPlace): Configurations {
  const { program } = place;
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
  step: MoveStep,
  place: WalkedPlace,
  near: ArrayLike<number>,
  inBranch: Branch | undefined,
): Reached | Cannot {
  const { robot, worldFromBase } = place;
  const { target } = step;
  const found = "q" in target ? (otherArm(robot, step, target.q) ?? reached(target.q)) : byPose(target);
  if (found.kind !== "reached") return found.kind === "no-solver" ? found.answer : found;
  return outsideLimits(robot, step, found.q_rad, numberedJoint) ?? found;

  function byPose(to: Extract<typeof target, { readonly pose: unknown }>): ReturnType<typeof flangeReached> {
    const flange = flangeOfTcp(worldFromBase, place.worldFromTarget(to, to.tool), place.tool(to.tool));
    return flangeReached(robot, step, flange, near, to.branch ?? inBranch);
  }
}

const reached = (q_rad: ArrayLike<number>): Reached => ({ kind: "reached", q_rad });
