import { branchOfOrthoParallel } from "../kinematics/branch.ts";
import { explainReach } from "../kinematics/explain.ts";
import { armScratch, flangePose, type ArmScratch } from "../kinematics/forward.ts";
import { outOfReach } from "../kinematics/inverse.ts";
import { MAX_BRANCHES, solveOrthoParallel } from "../kinematics/ortho-parallel.ts";
import type { Reach } from "../kinematics/reach.ts";
import { singularDistances } from "../kinematics/singularity.ts";
import { wristCentre } from "../kinematics/span.ts";
import type { OrthoParallelGeometry, Robot } from "../robots/robot.ts";
import { compose, identity, inverse, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, normalizeQuaternion, rotate, type Quaternion } from "../spatial/quaternion.ts";
import { wrapAngle } from "../spatial/units.ts";
import { dot, norm, normalize, scale, type Vector3 } from "../spatial/vector.ts";
import { jogJoints } from "./jog-joints.ts";
import type { JogBlock, Jogged } from "./jogged.ts";

/** Which axes a Cartesian jog runs along: those of the world, the robot base, the tool tip, or worldFromUser of a work frame. */
export type JogFrame = "world" | "base" | "tool" | Quaternion;

/** What the hand asks for: joint speeds [rad/s], or a twist of the tool tip [m/s, rad/s about the tip]. */
export type JogCommand =
  | { readonly kind: "joints"; readonly speed_rad_s: ArrayLike<number> }
  | { readonly kind: "tip"; readonly linear_mps: Vector3; readonly angular_rad_s: Vector3; readonly frame: JogFrame };

/** Where the arm stands and what it carries. */
export interface JogCell {
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
}

/** Working memory of `jogStep`: one per hand. */
export interface JogScratch {
  readonly raw: Float64Array; readonly best: Float64Array; readonly start: Float64Array; readonly ahead: Float64Array; readonly turned: Float64Array; readonly arm: ArmScratch;
  readonly baseFromFlange: Pose<"base", "flange">; readonly worldFromTcp: Pose<"world", "tcp">; readonly wanted: Pose<"world", "tcp">;
  readonly worldFromFlange: Pose<"world", "flange">; readonly baseFromTcp: Pose<"base", "tcp">;
  readonly baseFromWorld: Pose<"base", "world">; readonly tcpFromFlange: Pose<"tcp", "flange">;
  readonly linear: Vector3; readonly angular: Vector3; readonly masked: Vector3; readonly axis: Vector3; readonly turns: Vector3; readonly turn: Quaternion;
  /** The last turn in place of joints 1, 4, 6, this step's, and the wish it was for, so that one does not undo the other. All 0 where the tip moved. */
  readonly turnedLast: Vector3; readonly turnedNow: Vector3; readonly turnedFor: Float64Array;
}
export const jogScratch = (): JogScratch => ({
  raw: new Float64Array(6 * MAX_BRANCHES), best: new Float64Array(6), start: new Float64Array(6), ahead: new Float64Array(6), turned: new Float64Array(6), arm: armScratch(),
  baseFromFlange: identity(), worldFromTcp: identity(), wanted: identity(),
  worldFromFlange: identity(), baseFromTcp: identity(), baseFromWorld: identity(), tcpFromFlange: identity(),
  linear: [0, 0, 0], angular: [0, 0, 0], masked: [0, 0, 0], axis: [0, 0, 0], turns: [0, 0, 0], turn: [0, 0, 0, 1],
  turnedLast: [0, 0, 0], turnedNow: [0, 0, 0], turnedFor: new Float64Array(6),
});

const NONE: readonly JogBlock[] = [];
const AXES = ["x", "y", "z"] as const;
/** A step shortened below this [m, rad] is looked at twice: on a singularity the arm must turn in place instead. */
const ALL_BUT_STANDING = 1e-6;
const SHORTEST = 1e-12;
/** This near to a singularity [m, sine] the tip does not notice its joints being turned in place. */
const ON_SINGULARITY = 1e-8;
/** A turn in place below this share of the joint speeds is rounding. */
const LEAST_TURN = 1e-3;
/** Rounding of limits given in degrees. */
const LIMIT_SLACK_RAD = 1e-9;
/** At a singularity two branches meet; within this travel they are the same posture. */
const SAME_TRAVEL_RAD = 1e-6;
/** Weight of joints 2 and 3 in telling which solution continues the posture. */
const FOLLOWS_WRIST = 1000;
const TURN = 2 * Math.PI;
/** What is left of a step that leaves the reach is taken up to this near to the edge [m, rad]. */
const AT_THE_EDGE = 1e-5;
/** Two steps count as the same wish while their directions differ by less than this cosine. */
const SAME_WISH = 0.99;

/**
 * One step of jogging, from where the arm stands (row N-38).
 *
 *   worldFromTcp′ = ( p + F v dt,  exp(F ω dt) · R ),   F = axes of the jog frame
 *
 * Follows the branch the arm is in. A step that asks a joint for more than its speed is shortened as a whole, so that near
 * a singularity the tip slows down instead of the arm jumping; on a singularity the free joints turn in place towards the
 * wanted direction. Where the whole step leaves the reach, each coordinate is tried: those that can go on do (row N-39),
 * rotation goes or stops as one (row N-41). Where
 * none can, the last piece to the edge is taken, to 1e-5 (m, rad).
 *
 * @param q        joint angles [rad] the arm stands at. Read only.
 * @param dt_s     duration of the step; over 0.
 * @param out      receives the new angles, or those of `q` when nothing moves. May be `q`.
 * @param scratch  working memory; with it a step that is not blocked allocates nothing but its answer.
 */
export function jogStep(cell: JogCell, q: ArrayLike<number>, command: JogCommand, dt_s: number, out: Float64Array, scratch: JogScratch = jogScratch()): Jogged {
  if (command.kind === "joints") return jogJoints(cell.robot, q, command.speed_rad_s, dt_s, out);
  for (let j = 0; j < q.length; j++) out[j] = q[j]!;
  const family = cell.robot.family, { linear, angular, worldFromTcp } = scratch;
  if (family.kind !== "ortho-parallel") return refused({ kind: "no-solver", because: `${cell.robot.name} has no closed-form solver.` });
  if (!command.linear_mps.every(Number.isFinite) || !command.angular_rad_s.every(Number.isFinite) || !(dt_s > 0) || !out.every(Number.isFinite)) {
    return refused({ kind: "not-a-pose", because: "A jog speed, its duration or a joint angle is not a finite number." });
  }
  scratch.start.set(out);
  compose(cell.worldFromBase, flangePose(cell.robot.arm, out, scratch.baseFromFlange, scratch.arm), scratch.worldFromFlange);
  compose(scratch.worldFromFlange, cell.flangeFromTcp, worldFromTcp);
  inverse(cell.worldFromBase, scratch.baseFromWorld);
  inverse(cell.flangeFromTcp, scratch.tcpFromFlange);
  const frame = frameOf(command.frame, cell, worldFromTcp);
  scale(command.linear_mps, dt_s, linear);
  rotate(frame, scale(command.angular_rad_s, dt_s, angular), angular);

  forgetOtherWish(scratch);
  const whole = towards(cell, frame, true, true, true, true, dt_s, out, scratch);
  let jogged: Jogged = typeof whole === "number" ? { kind: "moved", fraction: whole, blocked: NONE } : oneByOne(cell, frame, dt_s, out, scratch);
  if (jogged.kind === "blocked") jogged = upToTheEdge(cell, frame, dt_s, out, scratch, jogged.blocked);
  if (jogged.kind === "blocked" || !undoesTheLast(scratch)) return jogged;
  out.set(scratch.start);
  return { kind: "blocked", blocked: refused(NEITHER_WAY).blocked.filter(({ coordinate }, c) => (c < 3 ? linear[c] !== 0 : norm(angular) !== 0) && !jogged.blocked.some(other => other.coordinate === coordinate)).concat(jogged.blocked) };
}

/** Halves the step until the largest share of it that stays in reach is known, and takes that. */
function upToTheEdge(cell: JogCell, frame: Quaternion, dt_s: number, out: Float64Array, scratch: JogScratch, blocked: readonly JogBlock[]): Jogged {
  const { linear, angular, masked } = scratch, length = norm(linear) + norm(angular);
  rotate(frame, linear, masked);
  let inside = 0, outside = 1;
  while ((outside - inside) * length > AT_THE_EDGE / 2) {
    const middle = (inside + outside) / 2;
    if (solveAt(cell, masked, true, middle, scratch) === undefined) inside = middle; else outside = middle;
  }
  if (inside * length < AT_THE_EDGE) return { kind: "blocked", blocked };
  scale(linear, inside, linear);
  scale(angular, inside, angular);
  const part = towards(cell, frame, true, true, true, true, dt_s, out, scratch);
  return typeof part === "number" ? { kind: "moved", fraction: part * inside, blocked: NONE } : { kind: "blocked", blocked };
}

/** Tries x, y, z and rotation on top of what already goes, again after each success: one may make room for another. */
function oneByOne(cell: JogCell, frame: Quaternion, dt_s: number, out: Float64Array, scratch: JogScratch): Jogged {
  const { linear, angular } = scratch;
  const asked = [linear[0] !== 0, linear[1] !== 0, linear[2] !== 0, norm(angular) !== 0], goes = [false, false, false, false];
  const why: (Reach | undefined)[] = [];
  let fraction = 0, progress = true;
  while (progress) {
    progress = false;
    for (let c = 0; c < 4; c++) {
      if (!asked[c]! || goes[c]!) continue;
      goes[c] = true;
      const part = towards(cell, frame, goes[0]!, goes[1]!, goes[2]!, goes[3]!, dt_s, out, scratch);
      if (typeof part === "number") { fraction = part; progress = true; why[c] = undefined; }
      else { goes[c] = false; why[c] = part; }
    }
  }
  const blocked: JogBlock[] = [];
  for (let c = 0; c < 4; c++) {
    const reach = why[c];
    if (reach !== undefined) blocked.push({ coordinate: AXES[c] ?? "rotation", reach, sentence: explainReach(reach) });
  }
  return goes.includes(true) ? { kind: "moved", fraction, blocked } : { kind: "blocked", blocked };
}

/**
 * The chosen coordinates of the wanted step, shortened until every joint keeps its speed.
 * Writes `out` and returns the fraction taken, or returns why the pose cannot be had and leaves `out` alone.
 */
function towards(cell: JogCell, frame: Quaternion, x: boolean, y: boolean, z: boolean, turns: boolean, dt_s: number, out: Float64Array, scratch: JogScratch): number | Reach {
  const { masked, linear, start, best } = scratch;
  masked[0] = x ? linear[0] : 0; masked[1] = y ? linear[1] : 0; masked[2] = z ? linear[2] : 0;
  rotate(frame, masked, masked);
  const length = norm(masked) + (turns ? norm(scratch.angular) : 0);
  for (let fraction = 1; fraction >= SHORTEST;) {
    const reach = solveAt(cell, masked, turns, fraction, scratch);
    if (reach !== undefined) return reach;
    const load = speedLoad(cell.robot, start, best, dt_s);
    if (load <= 1) {
      const turned = fraction < 1 && fraction * length < ALL_BUT_STANDING && turnInPlace(cell.robot, dt_s, out, scratch);
      if (turned !== false) return turned === true ? 0 : turned;
      out.set(best);
      scratch.turnedNow[0] = 0; scratch.turnedNow[1] = 0; scratch.turnedNow[2] = 0;
      return fraction;
    }
    scratch.turns[0] = best[0]! - start[0]!; scratch.turns[1] = best[3]! - start[3]!; scratch.turns[2] = best[5]! - start[5]!;
    fraction *= Math.max(0.05, Math.min(0.9, 0.98 / load));
  }
  const turned = turnInPlace(cell.robot, dt_s, out, scratch);
  return typeof turned === "boolean" ? 0 : turned;
}

/** Solves the start pose moved by that fraction; `best` receives the solution nearest to the start, or a reason is returned. */
function solveAt(cell: JogCell, shift: Vector3, turns: boolean, fraction: number, scratch: JogScratch): Reach | undefined {
  const { worldFromTcp, wanted, angular, axis, turn, baseFromFlange } = scratch, family = cell.robot.family;
  if (family.kind !== "ortho-parallel") return undefined;
  for (let i = 0; i < 3; i++) wanted.position[i] = worldFromTcp.position[i]! + shift[i]! * fraction;
  fromAxisAngle(normalize(angular, axis), turns ? norm(angular) * fraction : 0, turn);
  normalizeQuaternion(multiply(turn, worldFromTcp.quaternion, wanted.quaternion), wanted.quaternion);
  compose(scratch.baseFromWorld, wanted, scratch.baseFromTcp);
  compose(scratch.baseFromTcp, scratch.tcpFromFlange, baseFromFlange);
  const count = solveOrthoParallel(family, baseFromFlange, scratch.raw, scratch.start);
  return count === 0 ? outOfReach(cell.robot, baseFromFlange) : nearest(cell.robot, family, count, scratch);
}

/**
 * Copies the solution that continues the posture into `best`: joints 2 and 3, which no singularity of wrist or shoulder makes
 * leap, decide first, then least travel; of two that are as good as equal, one inside the limits.
 */
function nearest(robot: Robot, family: OrthoParallelGeometry, count: number, { raw, best, start }: JogScratch): Reach | undefined {
  let least = Infinity, chosen = 0, chosenJoint = 0;
  for (let s = 0; s < count; s++) {
    let total = 0;
    for (let j = 0; j < 6; j++) {
      const turned = raw[6 * s + j]! + TURN * Math.round((start[j]! - raw[6 * s + j]!) / TURN);
      raw[6 * s + j] = turned;
      total += Math.abs(turned - start[j]!) * (j === 1 || j === 2 ? FOLLOWS_WRIST : 1);
    }
    const outside = jointOutside(robot, raw, 6 * s, start);
    const preferred = total < least - SAME_TRAVEL_RAD || (total < least + SAME_TRAVEL_RAD && chosenJoint > 0 && outside === 0);
    if (preferred) { least = total; chosen = s; chosenJoint = outside; }
  }
  for (let j = 0; j < 6; j++) best[j] = raw[6 * chosen + j]!;
  return chosenJoint === 0 ? undefined : outsideLimits(robot, family, best, chosenJoint);
}

function outsideLimits(robot: Robot, family: OrthoParallelGeometry, q: Float64Array, joint: number): Reach {
  const { lower_rad, upper_rad } = robot.arm.joints[joint - 1]!.limits, wanted_rad = q[joint - 1]!;
  return { kind: "outside-limits", joint, wanted_rad, limit_rad: wanted_rad < lower_rad ? lower_rad : upper_rad, branch: branchOfOrthoParallel(family, q) };
}

/** First joint (from 1) that would leave its limits, or go further out of them; 0 when none does. */
function jointOutside(robot: Robot, angles: Float64Array, at: number, start: Float64Array): number {
  for (let j = 0; j < 6; j++) {
    const { lower_rad, upper_rad } = robot.arm.joints[j]!.limits, angle = angles[at + j]!;
    if ((angle > upper_rad + LIMIT_SLACK_RAD && angle > start[j]!) || (angle < lower_rad - LIMIT_SLACK_RAD && angle < start[j]!)) return j + 1;
  }
  return 0;
}

/** The largest joint speed of the step as a share of what that joint can do. */
function speedLoad(robot: Robot, from: Float64Array, to: Float64Array, dt_s: number): number {
  let load = 0;
  for (let j = 0; j < 6; j++) load = Math.max(load, Math.abs(to[j]! - from[j]!) / (robot.arm.joints[j]!.limits.speed_rad_s * dt_s));
  return load;
}

/**
 * On a singularity the wanted direction needs other angles of the free joints however short the step is: turns them towards
 * these while the tip stands still to 1e-8 (m, rad). `turns` is how far joints 1, 4 and 6 want to go.
 *
 * @returns false, with `out` and `best` as they were, where no joint is free; why not, where one stands at its limit.
 */
function turnInPlace(robot: Robot, dt_s: number, out: Float64Array, scratch: JogScratch): boolean | Reach {
  const { start, best, turned, turns } = scratch, family = robot.family;
  if (family.kind !== "ortho-parallel") return false;
  const { wrist, shoulder_m } = singularDistances(family, start);
  turned.set(best);
  const atShoulder = shoulder_m < ON_SINGULARITY && Math.abs(turns[0]) > ON_SINGULARITY;
  const done = atShoulder ? turnShoulder(robot, family, dt_s, scratch) : wrist < ON_SINGULARITY && turnWrist(robot, family, dt_s, scratch);
  if (done !== true) { best.set(turned); return done; }
  out.set(best);
  for (let i = 0; i < 3; i++) scratch.turnedNow[i] = turns[i]!;
  return true;
}

const NEITHER_WAY: Reach = { kind: "no-solver", because: "The arm stands on a singularity; turned in place to either side it meets a limit, and the tip would not move." };

/** Whether this step turned in place against the last one; if not, it is the last one from now on. Without it, a limit on either side would rock the arm for ever. */
function undoesTheLast({ turnedNow, turnedLast }: JogScratch): boolean {
  if (dot(turnedNow, turnedLast) < 0) return true;
  for (let i = 0; i < 3; i++) turnedLast[i] = turnedNow[i]!;
  return false;
}

/** A turn in place is held against the next one only while the hand goes on asking for about the same. */
function forgetOtherWish({ linear, angular, turnedFor, turnedLast }: JogScratch): void {
  let along = 0, now = 0, before = 0;
  for (let i = 0; i < 6; i++) {
    const value = i < 3 ? linear[i]! : angular[i - 3]!, last = turnedFor[i]!;
    along += value * last; now += value * value; before += last * last;
    turnedFor[i] = value;
  }
  if (!(along > SAME_WISH * Math.sqrt(now * before))) { turnedLast[0] = 0; turnedLast[1] = 0; turnedLast[2] = 0; }
}

/** Wrist centre on axis 1: the solver leaves joints 1 and 4 where it is told to, once the centre is on the axis to the last digit. */
function turnShoulder(robot: Robot, family: OrthoParallelGeometry, dt_s: number, scratch: JogScratch): boolean | Reach {
  const { start, best, ahead, baseFromFlange, raw, turns } = scratch;
  flangePose(robot.arm, start, baseFromFlange, scratch.arm);
  const centre = wristCentre(family, baseFromFlange);
  baseFromFlange.position[0] -= centre[0]; baseFromFlange.position[1] -= centre[1];
  for (let part = partWithin(robot, turns[0], turns[1], 0, dt_s), tries = 0; tries < 8; part /= 2, tries++) {
    ahead.set(start);
    ahead[0] = start[0]! + turns[0] * part; ahead[3] = start[3]! + turns[1] * part;
    const count = solveOrthoParallel(family, baseFromFlange, raw, ahead);
    const reach = count === 0 ? undefined : nearest(robot, family, count, scratch);
    if (reach !== undefined) return reach;
    const load = speedLoad(robot, start, best, dt_s);
    if (load <= 1) return load > LEAST_TURN;
  }
  return false;
}

/** Wrist straight: axes 4 and 6 are one line, and what one turns the other turns back. */
function turnWrist(robot: Robot, family: OrthoParallelGeometry, dt_s: number, scratch: JogScratch): boolean | Reach {
  const { start, best, turns } = scratch, part = partWithin(robot, 0, turns[1], turns[2], dt_s);
  best.set(start);
  best[3] = start[3]! + turns[1] * part; best[5] = start[5]! + turns[2] * part;
  // The bend that is left over would point elsewhere after the turn: it is taken out.
  const bend = wrapAngle(family.signs[4] * start[4]! - family.offsets_rad[4]);
  if (Math.abs(bend) < ON_SINGULARITY) best[4] = start[4]! - family.signs[4] * bend;
  const outside = jointOutside(robot, best, 0, start);
  return outside === 0 ? speedLoad(robot, start, best, dt_s) > LEAST_TURN : outsideLimits(robot, family, best, outside);
}

/** The share of these turns of joints 1, 4 and 6 that their speeds allow in one step. */
function partWithin(robot: Robot, turn1: number, turn4: number, turn6: number, dt_s: number): number {
  const joints = robot.arm.joints, load = (turn: number, joint: number): number => Math.abs(turn) / (joints[joint]!.limits.speed_rad_s * dt_s);
  return Math.min(1, 0.999 / Math.max(load(turn1, 0), load(turn4, 3), load(turn6, 5)));
}

/** Unit quaternion worldFromFrame of the axes a jog runs along. */
function frameOf(frame: JogFrame, cell: JogCell, worldFromTcp: Pose<"world", "tcp">): Quaternion {
  switch (frame) {
    case "world": return WORLD;
    case "base": return cell.worldFromBase.quaternion;
    case "tool": return worldFromTcp.quaternion;
    default: return frame;
  }
}
const WORLD: Quaternion = [0, 0, 0, 1];

const refused = (reach: Reach): Jogged => ({ kind: "blocked", blocked: (["x", "y", "z", "rotation"] as const).map(coordinate => ({ coordinate, reach, sentence: explainReach(reach) })) });
