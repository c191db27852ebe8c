import {
  degrees,
  explainReach,
  solveAll,
  type Branch,
  type JointLimits,
  type MoveStep,
  type Pose,
  type Robot,
} from "@twincell/core";
import { called, type Cannot } from "./cannot.ts";

/** Rounding of arithmetic is no violation of a limit [rad]. */
const LIMIT_SLACK_RAD = 1e-9;

type Named = Pick<MoveStep, "id" | "name">;
export type Reached = { readonly kind: "reached"; readonly q_rad: ArrayLike<number> };

/** What is wrong with joint angles that were taught on an arm of another number of joints. */
export function otherArm(robot: Robot, step: Named, q_rad: ArrayLike<number>): Cannot | undefined {
  const count = robot.arm.joints.length;
  if (q_rad.length === count) return undefined;
  return {
    kind: "cannot",
    step: step.id,
    sentence: `${called(step)} holds ${q_rad.length} joint angles; the ${robot.name} has ${count} joints.`,
    hint: "Teach the step again on this robot.",
  };
}

/**
 * The joint angles that bring the flange to a pose with least travel from `near`.
 *
 * @param branch  the posture that is asked for; any where it is left out.
 */
export function flangeReached(
  robot: Robot,
  step: Named,
  baseFromFlange: Pose<"base", "flange">,
  near: ArrayLike<number> | undefined,
  branch: Branch | undefined,
): Reached | Cannot | { readonly kind: "no-solver"; readonly answer: Cannot } {
  const reach = solveAll(robot, baseFromFlange, {
    ...(near === undefined ? {} : { near }),
    ...(branch === undefined ? {} : { branch }),
  });
  if (reach.kind === "reached") return { kind: "reached", q_rad: reach.solutions[0]!.q_rad };
  const answer: Cannot = {
    kind: "cannot",
    step: step.id,
    sentence: `${called(step)} cannot be reached. ${explainReach(reach)}`,
    hint: "Check the program: it says what would bring the step into reach.",
  };
  return reach.kind === "no-solver" ? { kind: "no-solver", answer } : answer;
}

/** The first joint outside its limits, counted from 0. */
function jointOutside(
  { arm: { joints } }: Robot,
  q_rad: ArrayLike<number>,
): { readonly joint: number; readonly limits: JointLimits } | undefined {
  const joint = joints.findIndex(
    ({ limits }, k) =>
      !(q_rad[k]! >= limits.lower_rad - LIMIT_SLACK_RAD && q_rad[k]! <= limits.upper_rad + LIMIT_SLACK_RAD),
  );
  return joint < 0 ? undefined : { joint, limits: joints[joint]!.limits };
}

/** @param axisName  what the controller calls its axes, counted from 0: "axis S", "joint 1". */
export function outsideLimits(
  robot: Robot,
  step: Named,
  q_rad: ArrayLike<number>,
  axisName: (axis: number) => string,
): Cannot | undefined {
  const outside = jointOutside(robot, q_rad);
  if (outside === undefined) return undefined;
  const {
    joint,
    limits: { lower_rad, upper_rad },
  } = outside;
  return {
    kind: "cannot",
    step: step.id,
    sentence: `${called(step)} turns ${axisName(joint)} to ${degrees(q_rad[joint]!).toFixed(2)}°; it may turn from ${degrees(lower_rad).toFixed(1)}° to ${degrees(upper_rad).toFixed(1)}°.`,
    hint: "Move the point, or choose another branch for it.",
  };
}
export const numberedJoint = (joint: number): string => `joint ${joint + 1}`;
