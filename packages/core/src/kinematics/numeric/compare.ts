import type { Robot } from "../../model/robot.ts";
import type { Pose } from "../../spatial/pose.ts";
import { degrees } from "../../spatial/units.ts";
import { explainReach } from "../explain.ts";
import { flangePose } from "../forward.ts";
import { solveAll, travel } from "../inverse.ts";
import { explainNumeric, solveDamped } from "./damped.ts";
import { solveFabrik } from "./fabrik.ts";
import { solveGradient } from "./gradient-descent.ts";
import { lengthAt, poseError } from "./pose-error.ts";

export const IK_METHODS = ["closed", "dls", "fabrik", "gradient"] as const;
export type IkMethod = (typeof IK_METHODS)[number];

/**
 * What one method made of a target. q is null where it has no answer; the errors are those of its flange, the jump is
 * Σ|Δθ| from the start.
 */
export interface MethodResult {
  readonly method: IkMethod;
  readonly q_rad: Float64Array | null;
  readonly position_m: number;
  readonly angle_rad: number;
  /** Steps, rounds or sweeps; 0 for the closed form. */
  readonly iterations: number;
  readonly jump_rad: number;
  readonly sentence: string;
}

/** One target through one method, from `q0`. @throws {JointCountFault} */
export function solveBy(
  method: IkMethod,
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  q0: ArrayLike<number>,
): MethodResult {
  const { arm } = robot;
  switch (method) {
    case "closed": {
      const reach = solveAll(robot, baseFromFlange, { near: q0 });
      return result(
        method,
        robot,
        baseFromFlange,
        q0,
        reach.kind === "reached" ? reach.solutions[0]!.q_rad : null,
        0,
        explainReach(reach),
      );
    }
    case "dls": {
      const answer = solveDamped(arm, baseFromFlange, q0);
      return result(
        method,
        robot,
        baseFromFlange,
        q0,
        answer.kind === "not-a-pose" ? null : answer.q_rad,
        answer.kind === "not-a-pose" ? 0 : answer.iterations,
        explainNumeric(answer),
      );
    }
    case "fabrik": {
      const answer = solveFabrik(arm, baseFromFlange, q0);
      if (answer.kind === "not-a-pose") return result(method, robot, baseFromFlange, q0, null, 0, answer.because);
      return result(method, robot, baseFromFlange, q0, answer.q_rad, answer.iterations, leftSentence(answer, "rounds"));
    }
    case "gradient": {
      const answer = solveGradient(arm, baseFromFlange, q0);
      if (answer.kind === "not-a-pose") return result(method, robot, baseFromFlange, q0, null, 0, answer.because);
      return result(method, robot, baseFromFlange, q0, answer.q_rad, answer.iterations, leftSentence(answer, "sweeps"));
    }
  }
}

/** The same target through each method (rows ). The caller measures time. @throws {JointCountFault} */
export const compareMethods = (
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  q0: ArrayLike<number>,
): MethodResult[] => IK_METHODS.map(method => solveBy(method, robot, baseFromFlange, q0));

/**
 * How a method does along a path, each pose solved from the answer before it. Jumps are the largest between two
 * following poses.
 */
export interface PathResult {
  readonly method: IkMethod;
  readonly solved: number;
  readonly worstPosition_m: number;
  readonly worstAngle_rad: number;
  /** Largest turn of one joint between two poses. */
  readonly jointJump_rad: number;
  /** Largest change of the orientation error between two poses: what an eye sees as the tool twitching (row X-22). */
  readonly orientationJump_rad: number;
  /** Per pose, for a plot: error of the place, of the orientation, and the turn of the joint that turned most. */
  readonly position_m: Float64Array;
  readonly angle_rad: Float64Array;
  readonly jump_rad: Float64Array;
}

/**
 * Follows a path of flange poses by one method. A pose without an answer leaves the arm where it is, and its errors are
 * that posture's. @throws {JointCountFault}
 */
export function comparePath(
  method: IkMethod,
  robot: Robot,
  path: readonly Pose<"base", "flange">[],
  q0: ArrayLike<number>,
): PathResult {
  const position_m = new Float64Array(path.length);
  const angle_rad = new Float64Array(path.length);
  const jump_rad = new Float64Array(path.length);
  const error = new Float64Array(6);
  const last = new Float64Array(3);
  let q: Float64Array = Float64Array.from(q0);
  let solved = 0;
  let orientationJump_rad = 0;
  path.forEach((wanted, i) => {
    const answer = solveBy(method, robot, wanted, q).q_rad;
    const next = answer ?? q;
    if (answer !== null) solved++;
    poseError(wanted, flangePose(robot.arm, next), error);
    position_m[i] = lengthAt(error, 0);
    angle_rad[i] = lengthAt(error, 3);
    jump_rad[i] = next.reduce((most, angle, j) => Math.max(most, Math.abs(angle - q[j]!)), 0);
    if (i > 0)
      orientationJump_rad = Math.max(
        orientationJump_rad,
        Math.hypot(error[3]! - last[0]!, error[4]! - last[1]!, error[5]! - last[2]!),
      );
    last.set(error.subarray(3));
    q = next;
  });
  const largest = (values: Float64Array, from = 0): number =>
    values.subarray(from).reduce((most, value) => Math.max(most, value), 0);
  return {
    method,
    solved,
    worstPosition_m: largest(position_m),
    worstAngle_rad: largest(angle_rad),
    jointJump_rad: largest(jump_rad, 1),
    orientationJump_rad,
    position_m,
    angle_rad,
    jump_rad,
  };
}

function result(
  method: IkMethod,
  robot: Robot,
  wanted: Pose<"base", "flange">,
  q0: ArrayLike<number>,
  q_rad: Float64Array | null,
  iterations: number,
  sentence: string,
): MethodResult {
  if (q_rad === null) return { method, q_rad, position_m: NaN, angle_rad: NaN, iterations, jump_rad: NaN, sentence };
  const error = new Float64Array(6);
  poseError(wanted, flangePose(robot.arm, q_rad), error);
  return {
    method,
    q_rad,
    position_m: lengthAt(error, 0),
    angle_rad: lengthAt(error, 3),
    iterations,
    jump_rad: travel(q_rad, q0),
    sentence,
  };
}

const leftSentence = (
  { iterations, position_m, angle_rad }: { iterations: number; position_m: number; angle_rad: number },
  unit: string,
): string =>
  `After ${iterations} ${unit} ${(position_m * 1000).toFixed(2)} mm and ${degrees(angle_rad).toFixed(2)}° are left.`;
