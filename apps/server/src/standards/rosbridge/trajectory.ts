import { emptyProgram, type CommandOutcome, type Program, type Robot, type Step } from "@twincell/core";
import type { TrajectoryGoal } from "./messages.ts";

/** Two points this near are one [rad or m]: where the robot stands is no point to go to. */
const SAME = 1e-4;

export type TrajectoryAnswer =
  | { readonly kind: "program"; readonly program: Program; readonly end_rad: readonly number[] }
  | { readonly kind: "refused"; readonly code: number; readonly sentence: string };
/** Error codes of `control_msgs/action/FollowJointTrajectory`. */
export const RESULT_CODES = { done: 0, goal: -1, joints: -2, time: -3, path: -4, end: -5 } as const;

/**
 * A trajectory of ROS as a program: each point a joint move that takes the time between the points. Inner points are
 * passed with blends, so that the arm does not rest at each; what is too fast for the robot is refused when it is
 * checked, like any program.
 *
 * @param q_rad  where the robot is.
 */
export function trajectoryProgram(
  { trajectory }: TrajectoryGoal,
  robot: Robot,
  q_rad: ArrayLike<number>,
): TrajectoryAnswer {
  const refused = (code: number, sentence: string): TrajectoryAnswer => ({ kind: "refused", code, sentence });
  const names = robot.arm.joints.map(joint => joint.name);
  const { joint_names, points } = trajectory;
  const at = names.map(name => joint_names.indexOf(name));
  if (joint_names.length !== names.length || at.includes(-1))
    return refused(
      RESULT_CODES.joints,
      `The trajectory names ${joint_names.join(", ")}; the robot has ${names.join(", ")}.`,
    );
  const steps: Step[] = [];
  let before: ArrayLike<number> = q_rad;
  let before_s = 0;
  for (const [i, { positions, time_from_start }] of points.entries()) {
    if (positions.length !== names.length)
      return refused(RESULT_CODES.goal, `Point ${i} has ${positions.length} positions for ${names.length} joints.`);
    const q = at.map(place => positions[place]!);
    const time_s = time_from_start - before_s;
    const away = Math.max(...q.map((value, joint) => Math.abs(value - before[joint]!)));
    if (i === 0 && away < SAME) {
      before_s = time_from_start;
      continue;
    }
    if (!(time_s > 0)) return refused(RESULT_CODES.time, `Point ${i} is not later than the one before it.`);
    if (away < SAME) steps.push({ id: `wait${i}`, type: "wait", s: time_s });
    else
      steps.push({
        id: `point${i}`,
        type: "move",
        path: "ptp",
        target: { q },
        speed: { time_s },
        blend_m: 0,
        ...(i < points.length - 1 ? { blend_ratio: 1 } : {}),
      });
    before = q;
    before_s = time_from_start;
  }
  return {
    kind: "program",
    program: { ...emptyProgram(robot.id, "ROS trajectory"), steps },
    end_rad: Array.from(before),
  };
}

/** The error code and the sentence of what became of it. */
export function resultOf(outcome: CommandOutcome): { readonly error_code: number; readonly error_string: string } {
  if (outcome.kind === "done") return { error_code: RESULT_CODES.done, error_string: "" };
  const { sentence, hint } = outcome.why;
  const code = outcome.kind === "refused" ? RESULT_CODES.goal : RESULT_CODES.path;
  return { error_code: code, error_string: `${sentence} ${hint}`.trim() };
}
