import { explainReach } from "../kinematics/explain.ts";
import { flangePose } from "../kinematics/forward.ts";
import type { Reach } from "../kinematics/reach.ts";
import { compose, inverse, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, normalizeQuaternion, rotate, type Quaternion } from "../spatial/quaternion.ts";
import { norm, normalize, scale, type Vector3 } from "../spatial/vector.ts";
import { jogScratch, speedLoad, type JogCell, type JogCommand, type JogFrame, type JogScratch } from "./jog-cell.ts";
import { jogJoints } from "./jog-joints.ts";
import { continueNumeric, fitScratch, noteStart, turnNumeric } from "./jog-numeric.ts";
import { continueOrthoParallel, turnOrthoParallel } from "./jog-ortho-parallel.ts";
import { continueThreeParallel, endsThere, shortestOfThreeParallel, turnThreeParallel } from "./jog-three-parallel.ts";
import type { JogBlock, Jogged } from "./jogged.ts";

export { jogScratch, type JogCell, type JogCommand, type JogFrame, type JogScratch } from "./jog-cell.ts";

const NONE: readonly JogBlock[] = [];
const AXES = ["x", "y", "z"] as const;
/** A step shortened below this [m, rad] is looked at twice: on a singularity the arm must turn in place instead. */
const ALL_BUT_STANDING = 1e-6;
const SHORTEST = 1e-12;
/**
 * A step cut down to all but nothing that then asks the joints for less than this share of their speed: between the two
 * lies a leap.
 */
const LEAPT = 0.02;
/** What is left of a step that leaves the reach is taken up to this near to the edge [m, rad]. */
const AT_THE_EDGE = 1e-5;
/** Two steps count as the same wish while their directions differ by less than this cosine. */
const SAME_WISH = 0.99;

/**
 * One step of jogging, from where the arm stands (row N-38).
 *
 *   worldFromTcp′ = ( p + F v dt,  exp(F ω dt) · R ),   F = axes of the jog frame
 *
 * Follows the branch the arm is in. A step that asks a joint for more than its speed is shortened as a whole, so that
 * near a singularity the tip slows down instead of the arm jumping; on a singularity the free joints turn in place
 * towards the wanted direction. Where the whole step leaves the reach, each coordinate is tried: those that can go on
 * do (row N-39), rotation goes or stops as one (row N-41). Where none can, the last piece to the edge is taken, to 1e-5
 * (m, rad).
 *
 * The ortho-parallel and three-parallel families jog by their closed forms, every other arm by damped least squares.
 *
 * @param q        joint angles [rad] the arm stands at. Read only.
 * @param dt_s     duration of the step; over 0.
 * @param out      receives the new angles, or those of `q` when nothing moves. May be `q`.
 * @param scratch  working memory; with it a step that is not blocked allocates nothing but its answer.
 */
export function jogStep(
  cell: JogCell,
  q: ArrayLike<number>,
  command: JogCommand,
  dt_s: number,
  out: Float64Array,
  scratch: JogScratch = jogScratch(),
): Jogged {
  if (command.kind === "joints") return jogJoints(cell.robot, q, command.speed_rad_s, dt_s, out);
  for (let j = 0; j < q.length; j++) out[j] = q[j]!;
  const { linear, angular, worldFromTcp } = scratch;
  if (
    !command.linear_mps.every(Number.isFinite) ||
    !command.angular_rad_s.every(Number.isFinite) ||
    !(dt_s > 0) ||
    !out.every(Number.isFinite)
  ) {
    return refused({
      kind: "not-a-pose",
      because: "A jog speed, its duration or a joint angle is not a finite number.",
    });
  }
  fitScratch(scratch, cell.robot);
  scratch.start.set(out);
  compose(
    cell.worldFromBase,
    flangePose(cell.robot.arm, out, scratch.baseFromFlange, scratch.arm),
    scratch.worldFromFlange,
  );
  if (scratch.numeric !== null) noteStart(scratch.numeric, scratch.baseFromFlange);
  compose(scratch.worldFromFlange, cell.flangeFromTcp, worldFromTcp);
  inverse(cell.worldFromBase, scratch.baseFromWorld);
  inverse(cell.flangeFromTcp, scratch.tcpFromFlange);
  const frame = frameOf(command.frame, cell, worldFromTcp);
  scale(command.linear_mps, dt_s, linear);
  rotate(frame, scale(command.angular_rad_s, dt_s, angular), angular);

  forgetOtherWish(scratch);
  const whole = towards(cell, frame, true, true, true, true, dt_s, out, scratch);
  let jogged: Jogged =
    typeof whole === "number"
      ? { kind: "moved", fraction: whole, blocked: NONE }
      : oneByOne(cell, frame, dt_s, out, scratch);
  if (jogged.kind === "blocked") jogged = upToTheEdge(cell, frame, dt_s, out, scratch, jogged.blocked);
  if (jogged.kind === "blocked" || !undoesTheLast(scratch)) return jogged;
  out.set(scratch.start);
  return {
    kind: "blocked",
    blocked: refused(NEITHER_WAY)
      .blocked.filter(
        ({ coordinate }, c) =>
          (c < 3 ? linear[c] !== 0 : norm(angular) !== 0) &&
          !jogged.blocked.some(other => other.coordinate === coordinate),
      )
      .concat(jogged.blocked),
  };
}

/** Halves the step until the largest share of it that stays in reach is known, and takes that. */
function upToTheEdge(
  cell: JogCell,
  frame: Quaternion,
  dt_s: number,
  out: Float64Array,
  scratch: JogScratch,
  blocked: readonly JogBlock[],
): Jogged {
  const { linear, angular, masked } = scratch;
  const length = norm(linear) + norm(angular);
  rotate(frame, linear, masked);
  let inside = 0;
  let outside = 1;
  while ((outside - inside) * length > AT_THE_EDGE / 2) {
    const middle = (inside + outside) / 2;
    if (solveAt(cell, masked, true, middle, scratch) === undefined) inside = middle;
    else outside = middle;
  }
  if (inside * length < AT_THE_EDGE) return { kind: "blocked", blocked };
  scale(linear, inside, linear);
  scale(angular, inside, angular);
  const part = towards(cell, frame, true, true, true, true, dt_s, out, scratch);
  return typeof part === "number"
    ? { kind: "moved", fraction: part * inside, blocked: NONE }
    : { kind: "blocked", blocked };
}

/** Tries x, y, z and rotation on top of what already goes, again after each success: one may make room for another. */
function oneByOne(cell: JogCell, frame: Quaternion, dt_s: number, out: Float64Array, scratch: JogScratch): Jogged {
  const { linear, angular } = scratch;
  const asked = [linear[0] !== 0, linear[1] !== 0, linear[2] !== 0, norm(angular) !== 0];
  const goes = [false, false, false, false];
  const why: (Reach | undefined)[] = [];
  let fraction = 0;
  let progress = true;
  while (progress) {
    progress = false;
    for (let c = 0; c < 4; c++) {
      if (!asked[c]! || goes[c]!) continue;
      goes[c] = true;
      const part = towards(cell, frame, goes[0]!, goes[1]!, goes[2]!, goes[3]!, dt_s, out, scratch);
      if (typeof part === "number") {
        fraction = part;
        progress = true;
        why[c] = undefined;
      } else {
        goes[c] = false;
        why[c] = part;
      }
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
function towards(
  cell: JogCell,
  frame: Quaternion,
  x: boolean,
  y: boolean,
  z: boolean,
  turns: boolean,
  dt_s: number,
  out: Float64Array,
  scratch: JogScratch,
): number | Reach {
  const { masked, linear, start, best, numeric } = scratch;
  masked[0] = x ? linear[0] : 0;
  masked[1] = y ? linear[1] : 0;
  masked[2] = z ? linear[2] : 0;
  rotate(frame, masked, masked);
  const length = norm(masked) + (turns ? norm(scratch.angular) : 0);
  const { family } = cell.robot;
  const shortest =
    numeric !== null
      ? ALL_BUT_STANDING / length
      : family.kind === "three-parallel"
        ? shortestOfThreeParallel(family, start) / length
        : SHORTEST;
  let ends = false;
  for (let fraction = 1; fraction >= shortest; ) {
    const reach = solveAt(cell, masked, turns, fraction, scratch);
    if (reach !== undefined) return reach;
    if (family.kind === "three-parallel" && endsThere(family, scratch)) {
      ends = true;
      fraction *= 0.5;
      continue;
    }
    const load = speedLoad(cell.robot, start, best, dt_s);
    if (load <= 1) {
      if (ends && fraction * length < ALL_BUT_STANDING) return ENDS_HERE;
      const turned = fraction < 1 && fraction * length < ALL_BUT_STANDING && turnInPlace(cell, dt_s, out, scratch);
      if (turned !== false) return turned === true ? 0 : turned;
      if (family.kind === "three-parallel" && fraction < 1 && fraction * length < ALL_BUT_STANDING && load < LEAPT)
        return ENDS_HERE;
      out.set(best);
      scratch.turnedNow.fill(0);
      return fraction;
    }
    if (numeric === null) {
      scratch.turns[0] = best[0]! - start[0]!;
      scratch.turns[1] = best[3]! - start[3]!;
      scratch.turns[2] = best[5]! - start[5]!;
    }
    fraction *= Math.max(0.05, Math.min(0.9, 0.98 / load));
  }
  if (ends) return ENDS_HERE;
  const turned = turnInPlace(cell, dt_s, out, scratch);
  return turned === false && family.kind !== "ortho-parallel" ? NO_WAY_OUT : typeof turned === "boolean" ? 0 : turned;
}

/**
 * On a singularity: turns joints while the tip stands still, into `out`. False where no joint is free; why not, where
 * one stands at its limit.
 */
function turnInPlace({ robot }: JogCell, dt_s: number, out: Float64Array, scratch: JogScratch): boolean | Reach {
  const { family } = robot;
  const { start, best, turnedNow, numeric } = scratch;
  const turned =
    numeric !== null
      ? turnNumeric(robot, numeric, dt_s, scratch)
      : family.kind === "three-parallel"
        ? turnThreeParallel(robot, family, dt_s, scratch)
        : family.kind === "ortho-parallel" && turnOrthoParallel(robot, family, dt_s, scratch);
  if (turned !== true) return turned;
  out.set(best);
  for (let j = 0; j < out.length; j++) turnedNow[j] = best[j]! - start[j]!;
  return true;
}

/**
 * Solves the start pose moved by that fraction; `best` receives the solution nearest to the start, or a reason is
 * returned.
 */
function solveAt(
  cell: JogCell,
  shift: Vector3,
  turns: boolean,
  fraction: number,
  scratch: JogScratch,
): Reach | undefined {
  const { worldFromTcp, wanted, angular, axis, turn, baseFromFlange, numeric } = scratch;
  const { robot } = cell;
  const { family } = robot;
  for (let i = 0; i < 3; i++) wanted.position[i] = worldFromTcp.position[i]! + shift[i]! * fraction;
  fromAxisAngle(normalize(angular, axis), turns ? norm(angular) * fraction : 0, turn);
  normalizeQuaternion(multiply(turn, worldFromTcp.quaternion, wanted.quaternion), wanted.quaternion);
  compose(scratch.baseFromWorld, wanted, scratch.baseFromTcp);
  compose(scratch.baseFromTcp, scratch.tcpFromFlange, baseFromFlange);
  if (numeric !== null) return continueNumeric(robot, numeric, scratch);
  return family.kind === "three-parallel"
    ? continueThreeParallel(robot, family, scratch)
    : family.kind === "ortho-parallel"
      ? continueOrthoParallel(robot, family, scratch)
      : undefined;
}

const NEITHER_WAY: Reach = {
  kind: "no-solver",
  because:
    "The arm stands on a singularity; turned in place to either side it meets a limit, and the tip would not move.",
};

const ENDS_HERE: Reach = {
  kind: "no-solver",
  because:
    "In this posture the arm goes no farther that way: it is stretched, folded or stands too near to axis 1, and would have to turn over into another posture.",
};

const NO_WAY_OUT: Reach = {
  kind: "no-solver",
  because: "The arm stands on a singularity, and no turn in place of its joints brings the tip that way.",
};

/**
 * Whether this step turned in place against the last one; if not, it is the last one from now on. Without it, a limit
 * on either side would rock the arm for ever.
 */
function undoesTheLast({ turnedNow, turnedLast }: JogScratch): boolean {
  let along = 0;
  for (let j = 0; j < turnedNow.length; j++) along += turnedNow[j]! * turnedLast[j]!;
  if (along < 0) return true;
  turnedLast.set(turnedNow);
  return false;
}

/** A turn in place is held against the next one only while the hand goes on asking for about the same. */
function forgetOtherWish({ linear, angular, turnedFor, turnedLast }: JogScratch): void {
  let along = 0;
  let now = 0;
  let before = 0;
  for (let i = 0; i < 6; i++) {
    const value = i < 3 ? linear[i]! : angular[i - 3]!;
    const last = turnedFor[i]!;
    along += value * last;
    now += value * value;
    before += last * last;
    turnedFor[i] = value;
  }
  if (!(along > SAME_WISH * Math.sqrt(now * before))) turnedLast.fill(0);
}

/** Unit quaternion worldFromFrame of the axes a jog runs along. */
function frameOf(frame: JogFrame, cell: JogCell, worldFromTcp: Pose<"world", "tcp">): Quaternion {
  switch (frame) {
    case "world":
      return WORLD;
    case "base":
      return cell.worldFromBase.quaternion;
    case "tool":
      return worldFromTcp.quaternion;
    default:
      return frame;
  }
}
const WORLD: Quaternion = [0, 0, 0, 1];

const refused = (reach: Reach): Jogged => ({
  kind: "blocked",
  blocked: (["x", "y", "z", "rotation"] as const).map(coordinate => ({
    coordinate,
    reach,
    sentence: explainReach(reach),
  })),
});
