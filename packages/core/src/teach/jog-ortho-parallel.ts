import { branchOfOrthoParallel } from "../kinematics/branch.ts";
import { flangePose } from "../kinematics/forward.ts";
import { outOfReach } from "../kinematics/inverse.ts";
import { solveOrthoParallel } from "../kinematics/ortho-parallel.ts";
import type { Reach } from "../kinematics/reach.ts";
import { singularDistances } from "../kinematics/singularity.ts";
import { wristCentre } from "../kinematics/span.ts";
import type { OrthoParallelGeometry, Robot } from "../model/robot.ts";
import { wrapAngle } from "../spatial/units.ts";
import { jointOutside, MIN_TURN, nearestLimit, ON_SINGULARITY, speedLoad, type JogScratch } from "./jog-cell.ts";

/** At a singularity two branches meet; within this travel they are the same posture. */
const SAME_TRAVEL_RAD = 1e-6;
/** Weight of joints 2 and 3 in telling which solution continues the posture. */
const FOLLOWS_WRIST = 1000;
const TURN = 2 * Math.PI;

/** The posture that continues `start` at `baseFromFlange`: into `best`, or why there is none. */
export function continueOrthoParallel(
  robot: Robot,
  family: OrthoParallelGeometry,
  scratch: JogScratch,
): Reach | undefined {
  const count = solveOrthoParallel(family, scratch.baseFromFlange, scratch.raw, scratch.start);
  return count === 0 ? outOfReach(robot, scratch.baseFromFlange) : nearest(robot, family, count, scratch);
}

/**
 * Copies the solution that continues the posture into `best`: joints 2 and 3, which no singularity of wrist or shoulder
 * makes leap, decide first, then least travel; of two that are as good as equal, one inside the limits.
 */
function nearest(
  robot: Robot,
  family: OrthoParallelGeometry,
  count: number,
  { raw, best, start }: JogScratch,
): Reach | undefined {
  let least = Infinity;
  let chosen = 0;
  let chosenJoint = 0;
  for (let s = 0; s < count; s++) {
    let total = 0;
    for (let j = 0; j < 6; j++) {
      const turned = raw[6 * s + j]! + TURN * Math.round((start[j]! - raw[6 * s + j]!) / TURN);
      raw[6 * s + j] = turned;
      total += Math.abs(turned - start[j]!) * (j === 1 || j === 2 ? FOLLOWS_WRIST : 1);
    }
    const outside = jointOutside(robot, raw, 6 * s, start);
    const preferred =
      total < least - SAME_TRAVEL_RAD || (total < least + SAME_TRAVEL_RAD && chosenJoint > 0 && outside === 0);
    if (preferred) {
      least = total;
      chosen = s;
      chosenJoint = outside;
    }
  }
  for (let j = 0; j < 6; j++) best[j] = raw[6 * chosen + j]!;
  return chosenJoint === 0 ? undefined : nearestLimit(robot, best, chosenJoint, branchOfOrthoParallel(family, best));
}

/**
 * On a singularity the wanted direction needs other angles of the free joints however short the step is: turns them
 * towards these while the tip stands still to 1e-8 (m, rad). `turns` is how far joints 1, 4 and 6 want to go.
 *
 * @returns true with the turned posture in `best`; else with `best` as it was: false where no joint is free, why not
 *   where one stands at its limit.
 */
export function turnOrthoParallel(
  robot: Robot,
  family: OrthoParallelGeometry,
  dt_s: number,
  scratch: JogScratch,
): boolean | Reach {
  const { start, best, turned, turns } = scratch;
  const { wrist, shoulder_m } = singularDistances(family, start);
  turned.set(best);
  const atShoulder = shoulder_m < ON_SINGULARITY && Math.abs(turns[0]) > ON_SINGULARITY;
  const done = atShoulder
    ? turnShoulder(robot, family, dt_s, scratch)
    : wrist < ON_SINGULARITY && turnWrist(robot, family, dt_s, scratch);
  if (done !== true) best.set(turned);
  return done;
}

/**
 * Wrist centre on axis 1: the solver leaves joints 1 and 4 where it is told to, once the centre is on the axis to the
 * last digit.
 */
function turnShoulder(robot: Robot, family: OrthoParallelGeometry, dt_s: number, scratch: JogScratch): boolean | Reach {
  const { start, best, ahead, baseFromFlange, raw, turns } = scratch;
  flangePose(robot.arm, start, baseFromFlange, scratch.arm);
  const centre = wristCentre(family, baseFromFlange);
  baseFromFlange.position[0] -= centre[0];
  baseFromFlange.position[1] -= centre[1];
  for (let part = partWithin(robot, turns[0], turns[1], 0, dt_s), tries = 0; tries < 8; part /= 2, tries++) {
    ahead.set(start);
    ahead[0] = start[0]! + turns[0] * part;
    ahead[3] = start[3]! + turns[1] * part;
    const count = solveOrthoParallel(family, baseFromFlange, raw, ahead);
    const reach = count === 0 ? undefined : nearest(robot, family, count, scratch);
    if (reach !== undefined) return reach;
    const load = speedLoad(robot, start, best, dt_s);
    if (load <= 1) return load > MIN_TURN;
  }
  return false;
}

/** Wrist straight: axes 4 and 6 are one line, and what one turns the other turns back. */
function turnWrist(robot: Robot, family: OrthoParallelGeometry, dt_s: number, scratch: JogScratch): boolean | Reach {
  const { start, best, turns } = scratch;
  const part = partWithin(robot, 0, turns[1], turns[2], dt_s);
  best.set(start);
  best[3] = start[3]! + turns[1] * part;
  best[5] = start[5]! + turns[2] * part;
  // The bend that is left over would point elsewhere after the turn: it is taken out.
  const bend = wrapAngle(family.signs[4] * start[4]! - family.offsets_rad[4]);
  if (Math.abs(bend) < ON_SINGULARITY) best[4] = start[4]! - family.signs[4] * bend;
  const outside = jointOutside(robot, best, 0, start);
  return outside === 0
    ? speedLoad(robot, start, best, dt_s) > MIN_TURN
    : nearestLimit(robot, best, outside, branchOfOrthoParallel(family, best));
}

/** The share of these turns of joints 1, 4 and 6 that their speeds allow in one step. */
function partWithin(robot: Robot, turn1: number, turn4: number, turn6: number, dt_s: number): number {
  const joints = robot.arm.joints;
  const load = (turn: number, joint: number): number => Math.abs(turn) / (joints[joint]!.limits.speed_rad_s * dt_s);
  return Math.min(1, 0.999 / Math.max(load(turn1, 0), load(turn4, 3), load(turn6, 5)));
}
