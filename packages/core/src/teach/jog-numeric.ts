import { dampedScratch, explainNumeric, solveDamped } from "../kinematics/numeric/damped.ts";
import { descend } from "../kinematics/numeric/descend.ts";
import { jacobian } from "../kinematics/jacobian.ts";
import { lengthOfArm } from "../kinematics/numeric/pose-error.ts";
import type { Reach } from "../kinematics/reach.ts";
import type { Robot } from "../model/robot.ts";
import type { SerialArm } from "../model/arm.ts";
import { copyPose, identity, type Pose } from "../spatial/pose.ts";
import { symmetricEigen } from "../spatial/eigen.ts";
import { MIN_TURN, speedLoad, type JogScratch, type NumericJog } from "./jog-cell.ts";

const numericJog = (arm: SerialArm): NumericJog => ({
  arm,
  damped: dampedScratch(arm.joints.length),
  found: new Float64Array(arm.joints.length),
  baseFromStart: identity(),
  turnWeight_m: 0.3 * lengthOfArm(arm),
});

/** Fits the scratch to the robot: once, when it first meets it. */
export function fitScratch(scratch: JogScratch, robot: Robot): void {
  const n = robot.arm.joints.length;
  if (scratch.start.length !== n) {
    scratch.start = new Float64Array(n);
    scratch.best = new Float64Array(n);
    scratch.turned = new Float64Array(n);
    scratch.turnedLast = new Float64Array(n);
    scratch.turnedNow = new Float64Array(n);
  }
  if (robot.family.kind === "ortho-parallel" || robot.family.kind === "three-parallel") scratch.numeric = null;
  else if (scratch.numeric?.arm !== robot.arm) scratch.numeric = numericJog(robot.arm);
}

const STEPS = 40;
const MET = { position_m: 1e-9, angle_rad: 1e-9 } as const;
/**
 * A solution this near [rad, the joint that turns most] continues the posture; a farther one is compared with what lies
 * behind the singularity.
 */
const CONTINUES_RAD = 0.2;
/**
 * On a singularity the downhill direction does not show the way out: the descent starts again this far beside it, to
 * both sides, farther where nearer finds nothing [rad].
 */
const BESIDE_RAD = [0.03, 0.1, 0.25] as const;

/**
 * The posture that continues `start` at `baseFromFlange`, into `best`, or why there is none. Descends from where the
 * arm stands; where that finds nothing near, from beside it along the directions in which the tip does not move.
 */
export function continueNumeric(robot: Robot, jog: NumericJog, scratch: JogScratch): Reach | undefined {
  const { damped, found } = jog;
  const { start, best, baseFromFlange } = scratch;
  damped.q.set(start);
  let least = attempt(jog, baseFromFlange, start, found, Infinity);
  if (least > CONTINUES_RAD) {
    const free = freeDirections(jog, start);
    for (let k = 0; k < BESIDE_RAD.length && (k === 0 || least === Infinity); k++) {
      for (const direction of free)
        for (const side of [BESIDE_RAD[k]!, -BESIDE_RAD[k]!]) {
          for (let j = 0; j < start.length; j++) damped.q[j] = start[j]! + side * direction[j]!;
          least = attempt(jog, baseFromFlange, start, found, least);
        }
    }
  }
  if (least < Infinity) {
    best.set(found);
    return undefined;
  }
  const why = solveDamped(robot.arm, baseFromFlange, start, {}, damped);
  return { kind: "no-solver", because: explainNumeric(why) };
}

/** Descends from where `damped.q` was put, and keeps the answer when it is nearer to `start` than `least`. */
function attempt(
  { arm, damped, turnWeight_m }: NumericJog,
  wanted: Pose<"base", "flange">,
  start: Float64Array,
  found: Float64Array,
  least: number,
): number {
  aim.turnWeight_m = turnWeight_m;
  if (!descend(arm, wanted, aim, damped)) return least;
  let travel = 0;
  for (let j = 0; j < start.length; j++) travel = Math.max(travel, Math.abs(damped.q[j]! - start[j]!));
  if (!(travel < least)) return least;
  found.set(damped.q);
  return travel;
}
const aim = { ...MET, steps: STEPS, turnWeight_m: 0 };

/**
 * Directions of joint space in which the tip hardly moves: the weakest of JᵀJ, and the next where there are more joints
 * than coordinates.
 */
function freeDirections({ arm, damped }: NumericJog, q: Float64Array): readonly Float64Array[] {
  const n = q.length;
  const rows = jacobian(arm, q, null, damped.rows, damped.jacobian);
  const normal = new Float64Array(n * n);
  for (let i = 0; i < n; i++)
    for (let j = 0; j < n; j++)
      for (let row = 0; row < 6; row++) normal[i * n + j]! += rows[row * n + i]! * rows[row * n + j]!;
  return symmetricEigen(normal).vectors.slice(Math.min(5, n - 1));
}

/**
 * Turns the joints from `start` towards `best` while the tip stands still: a share of the way that the joint speeds
 * allow, then down to the present pose again from there. On a singularity there is such a way; elsewhere the descent
 * comes back.
 *
 * @param baseFromStart  pose of the flange at `start`.
 * @returns true with the turned posture in `best`; false, with `best` as it was, where no turn is possible.
 */
export function turnNumeric(robot: Robot, jog: NumericJog, dt_s: number, scratch: JogScratch): boolean {
  const { damped, baseFromStart } = jog;
  const { start, best } = scratch;
  const n = start.length;
  aim.turnWeight_m = jog.turnWeight_m;
  for (let part = Math.min(1, 0.95 / speedLoad(robot, start, best, dt_s)), tries = 0; tries < 6; part /= 2, tries++) {
    for (let j = 0; j < n; j++) damped.q[j] = start[j]! + part * (best[j]! - start[j]!);
    if (!descend(robot.arm, baseFromStart, aim, damped)) continue;
    const load = speedLoad(robot, start, damped.q, dt_s);
    if (load > 1) continue;
    if (load < MIN_TURN) return false;
    best.set(damped.q);
    return true;
  }
  return false;
}

/** Notes where the flange stands before the step. */
export const noteStart = (jog: NumericJog, baseFromFlange: Pose<"base", "flange">): void => {
  copyPose(baseFromFlange, jog.baseFromStart);
};
