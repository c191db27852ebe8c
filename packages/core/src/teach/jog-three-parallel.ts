import { branchOfThreeParallel } from "../kinematics/branch.ts";
import { settled } from "../kinematics/candidates.ts";
import { outOfReach } from "../kinematics/out-of-reach.ts";
import type { Reach } from "../kinematics/reach.ts";
import { refine } from "../kinematics/refine.ts";
import { solveThreeParallel } from "../kinematics/three-parallel.ts";
import type { Robot, ThreeParallelGeometry } from "../model/robot.ts";
import { jointOutside, MIN_TURN, nearestLimit, ON_SINGULARITY, speedLoad, type JogScratch } from "./jog-cell.ts";

/**
 * Two branches are the same posture where they meet; elsewhere going over costs this much per sine of the elbow or
 * metre of the shoulder.
 */
const STAYS = 1000;
/** Of two postures as near as this [rad] one inside the limits is taken. */
const SAME_TRAVEL_RAD = 1e-6;
/** Steps in which a turn in place is looked at before it is begun, and the most a joint may leap in one [rad]. */
const AHEAD = 48;
const LEAP_RAD = 1;
const SHORTEST_STRAIGHT = 1e-5;
const SHORTEST = 1e-10;
const SETTLED = 1e-9;
/**
 * Farther than this [m, sine] from where two branches meet the one does not go on as the other; the wrist may be run
 * straight through from farther.
 */
const TURNED_OVER = 1e-3;
const BENT = 0.3;
const TURN = 2 * Math.PI;

/**
 * The posture that continues `start` at `baseFromFlange`: into `best`, or why there is none. The candidates stay in
 * `raw`, each next to the start.
 */
export function continueThreeParallel(
  robot: Robot,
  family: ThreeParallelGeometry,
  scratch: JogScratch,
): Reach | undefined {
  const { raw, best, start, baseFromFlange, costs } = scratch;
  const count = solveThreeParallel(family, baseFromFlange, raw, start);
  scratch.count = count;
  for (let s = 0; s < count; s++) {
    const at = 6 * s;
    let cost = 0;
    for (let j = 0; j < 6; j++) {
      const turned = raw[at + j]! + TURN * Math.round((start[j]! - raw[at + j]!) / TURN);
      raw[at + j] = turned;
      cost += Math.abs(turned - start[j]!);
    }
    costs[s] = cost + STAYS * turnedOver(family, start, raw, at);
  }
  for (let tried = 0; tried < count; tried++) {
    let chosen = -1;
    let outside = 0;
    for (let s = 0; s < count; s++) {
      if (costs[s] === Infinity) continue;
      const beyond = jointOutside(robot, raw, 6 * s, start);
      if (
        chosen < 0 ||
        costs[s]! < costs[chosen]! - SAME_TRAVEL_RAD ||
        (costs[s]! < costs[chosen]! + SAME_TRAVEL_RAD && outside > 0 && beyond === 0)
      ) {
        chosen = s;
        outside = beyond;
      }
    }
    if (chosen < 0) break;
    for (let j = 0; j < 6; j++) best[j] = raw[6 * chosen + j]!;
    if (outside > 0) return nearestLimit(robot, best, outside, branchOfThreeParallel(family, best));
    if (settled(robot, baseFromFlange, best, scratch.solver)) return undefined;
    costs[chosen] = Infinity;
  }
  return outOfReach(robot, baseFromFlange);
}

const isStraight = (family: ThreeParallelGeometry, q: Float64Array): boolean =>
  Math.abs(wristSine(family, q)) < ON_SINGULARITY;

/**
 * The shortest step worth a look [m, rad]: from a straight wrist the formula takes a shorter one for none; elsewhere
 * rounding of the arm's file ends it.
 */
export const shortestOfThreeParallel = (family: ThreeParallelGeometry, start: Float64Array): number =>
  isStraight(family, start) ? SHORTEST_STRAIGHT : SHORTEST;

/**
 * Axes 4 and 6 parallel: joints 2, 3, 4 and 6 are then a four-bar linkage that turns while the tip stands still to 1e-8
 * (m, rad). Turns it towards the θ6 of a candidate of the last step, the nearest to which the way is free.
 *
 * @returns true with the turned posture in `best`; else with `best` as it was: false where there is no such way, why
 *   not where one ends at a limit.
 */
export function turnThreeParallel(
  robot: Robot,
  family: ThreeParallelGeometry,
  dt_s: number,
  scratch: JogScratch,
): boolean | Reach {
  const { start, best, turned, raw, count, solver, baseFromFlange } = scratch;
  if (!isStraight(family, start)) return false;
  const straight = Math.cos(family.signs[4] * start[4]! - family.offsets_rad[4]) > 0 ? 0 : Math.PI;
  turned.set(best);
  let turn = Infinity;
  let why: Reach | false = false;
  let shortest = Infinity;
  for (let s = 0; s < count; s++) {
    // So near to a straight wrist the roundings of the arm's file turn θ6 by more than a step: it is refined.
    const { q } = solver;
    for (let j = 0; j < 6; j++) q[j] = raw[6 * s + j]!;
    if (
      turnedOver(family, start, q, 0) > TURNED_OVER ||
      !(refine(robot.arm, q, baseFromFlange, solver.refine) < SETTLED)
    )
      continue;
    const direct = q[5]! - start[5]!;
    for (const way of [direct, direct > 0 ? direct - TURN : direct + TURN]) {
      if (Math.abs(way) >= Math.abs(turn)) continue;
      const stop = lookAhead(robot, family, straight, way, scratch);
      if (stop === undefined) turn = way;
      else if (stop !== false && Math.abs(way) < shortest) {
        shortest = Math.abs(way);
        why = stop;
      }
    }
  }
  best.set(turned);
  if (turn === Infinity) return why;
  for (
    let part = Math.min(1, (0.95 * robot.arm.joints[5]!.limits.speed_rad_s * dt_s) / Math.abs(turn)), tries = 0;
    tries < 12;
    tries++
  ) {
    if (!turnLinkage(family, straight, turn * part, start, start, best)) break;
    const load = speedLoad(robot, start, best, dt_s);
    if (load <= 1) {
      if (load > MIN_TURN) return true;
      break;
    }
    part *= 0.95 / load;
  }
  best.set(turned);
  return false;
}

/**
 * Undefined where θ6 can be turned so far in place; false where the linkage does not go on; why not, where a joint
 * meets its limit.
 */
function lookAhead(
  robot: Robot,
  family: ThreeParallelGeometry,
  straight: number,
  turn: number,
  { start, best, ahead }: JogScratch,
): Reach | false | undefined {
  ahead.set(start);
  for (let k = 1; k <= AHEAD; k++) {
    if (!turnLinkage(family, straight, (turn * k) / AHEAD, start, ahead, best)) return false;
    for (let j = 0; j < 6; j++) if (Math.abs(best[j]! - ahead[j]!) > LEAP_RAD) return false;
    const outside = jointOutside(robot, best, 0, start);
    if (outside > 0) return nearestLimit(robot, best, outside, branchOfThreeParallel(family, best));
    ahead.set(best);
  }
  return undefined;
}

/**
 * The posture whose θ6 is turned by so much, tip, shoulder and elbow as in `from`, and θ5 straight:
 *
 *   φ′ = φ ∓ Δθ6,   axis 4 at (x, z) = wrist − c5 (sin φ′, cos φ′),   θ3 by the cosine law, its sign kept
 *
 * @param next  the answer is counted in whole turns next to it.
 * @returns false, with `out` untouched, where the arm does not reach so.
 */
function turnLinkage(
  family: ThreeParallelGeometry,
  straight: number,
  turn: number,
  from: Float64Array,
  next: Float64Array,
  out: Float64Array,
): boolean {
  const { signs, offsets_rad, c2_m: c2, c3_m: c3, c5_m: c5 } = family;
  const t2 = signs[1] * from[1]! - offsets_rad[1];
  const t3 = signs[2] * from[2]! - offsets_rad[2];
  const t23 = t2 + t3;
  const phi = t23 + signs[3] * from[3]! - offsets_rad[3];
  const turned = phi + (straight === 0 ? -1 : 1) * signs[5] * turn;
  const x = c2 * Math.sin(t2) + c3 * Math.sin(t23) + c5 * (Math.sin(phi) - Math.sin(turned));
  const z = c2 * Math.cos(t2) + c3 * Math.cos(t23) + c5 * (Math.cos(phi) - Math.cos(turned));
  const cos3 = (x * x + z * z - c2 * c2 - c3 * c3) / (2 * c2 * c3);
  if (cos3 > 1 || cos3 < -1) return false;
  const sin3 = (Math.sin(t3) < 0 ? -1 : 1) * Math.sqrt((1 - cos3) * (1 + cos3));
  const bent = Math.atan2(sin3, cos3);
  const lean = Math.atan2(x, z) - Math.atan2(c3 * sin3, c2 + c3 * cos3);
  out[0] = from[0]!;
  put(family, 1, lean, next, out);
  put(family, 2, bent, next, out);
  put(family, 3, turned - lean - bent, next, out);
  put(family, 4, straight, next, out);
  out[5] = from[5]! + turn;
  return true;
}

function put(
  { signs, offsets_rad }: ThreeParallelGeometry,
  joint: number,
  angle: number,
  next: Float64Array,
  out: Float64Array,
): void {
  const q = signs[joint]! * (angle + offsets_rad[joint]!);
  out[joint] = q + TURN * Math.round((next[joint]! - q) / TURN);
}

/**
 * Whether `best` stands in another branch than `start` and nowhere near to where the two meet: the posture itself does
 * not go on.
 */
export const endsThere = (family: ThreeParallelGeometry, { start, best }: JogScratch): boolean =>
  turnedOver(family, start, best, 0) > TURNED_OVER ||
  (wristSine(family, start) * wristSine(family, best) < 0 && Math.abs(wristSine(family, start)) > BENT);

/**
 * How far the start is from where its shoulder and elbow meet those of a posture [m, sine]; 0 where these are the same.
 */
function turnedOver(family: ThreeParallelGeometry, start: Float64Array, q: Float64Array, at: number): number {
  const elbow = elbowSine(family, start, 0);
  const shoulder = aheadOf(family, start, 0);
  return (
    (elbowSine(family, q, at) * elbow < 0 ? Math.abs(elbow) : 0) +
    (aheadOf(family, q, at) * shoulder < 0 ? Math.abs(shoulder) : 0)
  );
}

const wristSine = ({ signs, offsets_rad }: ThreeParallelGeometry, q: Float64Array): number =>
  Math.sin(signs[4] * q[4]! - offsets_rad[4]);
const elbowSine = ({ signs, offsets_rad }: ThreeParallelGeometry, q: Float64Array, at: number): number =>
  Math.sin(signs[2] * q[at + 2]! - offsets_rad[2]);

/** How far the meeting of axes 5 and 6 stands in front of axis 1 [m]; behind it where negative. */
function aheadOf(
  { signs, offsets_rad, a1_m, c2_m, c3_m, c5_m }: ThreeParallelGeometry,
  q: Float64Array,
  at: number,
): number {
  const t2 = signs[1] * q[at + 1]! - offsets_rad[1];
  const t23 = t2 + signs[2] * q[at + 2]! - offsets_rad[2];
  return (
    a1_m + c2_m * Math.sin(t2) + c3_m * Math.sin(t23) + c5_m * Math.sin(t23 + signs[3] * q[at + 3]! - offsets_rad[3])
  );
}
