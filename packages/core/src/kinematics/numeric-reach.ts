import { seededRandom } from "../random.ts";
import type { Robot } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { explainNumeric, solveDamped } from "./numeric/damped.ts";
import { dampedScratch } from "./numeric/damped-scratch.ts";
import type { Reach } from "./reach.ts";
import { minSingularValue } from "./singularity.ts";

/** Starts of the search: `near` or the home posture, then drawn evenly from inside the limits. Always the same ones. */
const STARTS = 24;
const SEED = 11;
/** Two answers this close are one [rad, m]. */
const SAME = 1e-5;
const SINGULAR = 1e-6;

/**
 * Postures that damped least squares found, inside the limits, and why the start that came nearest met nothing, where
 * none did.
 */
export interface NumericBranches {
  readonly found: readonly Float64Array[];
  readonly because: string;
}

/**
 * Postures of an arm without a closed form, by damped least squares from 24 starts. Of up to six joints all that are
 * found, of more joints, where there are as many as one likes, the first. None found is no proof that there is none.
 *
 * @param near  where the first start is; else the home posture. Angles that are none fall back to it.
 */
export function numericBranches(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  near: ArrayLike<number> | undefined,
): NumericBranches {
  const { arm } = robot;
  const n = arm.joints.length;
  const scratch = dampedScratch(n);
  const random = seededRandom(SEED);
  const found: Float64Array[] = [];
  let start: Float64Array =
    near === undefined || !Array.from(near).every(Number.isFinite)
      ? Float64Array.from(robot.home_rad)
      : Float64Array.from(near);
  let because = "";
  let least = Infinity;
  for (let k = 0; k < STARTS; k++) {
    const answer = solveDamped(arm, baseFromFlange, start, {}, scratch);
    if (answer.kind === "not-a-pose") return { found, because: answer.because };
    if (answer.kind === "converged") {
      if (!found.some(other => other.every((value, j) => Math.abs(value - answer.q_rad[j]!) < SAME)))
        found.push(answer.q_rad);
      if (n > 6) break;
    } else if (answer.position_m + answer.angle_rad < least) {
      least = answer.position_m + answer.angle_rad;
      because = explainNumeric(answer);
    }
    start = Float64Array.from(
      arm.joints,
      ({ limits: { lower_rad, upper_rad } }) => lower_rad + (upper_rad - lower_rad) * random(),
    );
  }
  return { found, because };
}

/**
 * Whether a pose is reached, by search: not all branches are claimed, and a pose that is not met may still have a
 * posture.
 */
export function numericReach(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  near: ArrayLike<number> | undefined,
): Reach {
  const { found, because } = numericBranches(robot, baseFromFlange, near);
  if (found.length === 0)
    return {
      kind: "no-solver",
      because: `From ${STARTS} starts damped least squares found no posture of ${robot.name}; the nearest: ${because}`,
    };
  const distance = (q: Float64Array): number =>
    near === undefined ? 0 : q.reduce((sum, value, j) => sum + Math.abs(value - near[j]!), 0);
  return {
    kind: "reached",
    method: "numeric",
    considered: STARTS,
    singular: found.some(q => minSingularValue(robot.arm, q) < SINGULAR),
    solutions: found.toSorted((a, b) => distance(a) - distance(b)).map(q_rad => ({ q_rad, branch: undefined })),
  };
}
