import type { Robot } from "../robots/robot.ts";
import { compose, identity, inverse, posesAgree, type Pose } from "../spatial/pose.ts";
import { branchOfOrthoParallel, sameBranch, type Branch } from "./branch.ts";
import { isSingular } from "./singularity.ts";
import { armScratch, flangePose, type ArmScratch } from "./forward.ts";
import { MAX_BRANCHES, solveOrthoParallel } from "./ortho-parallel.ts";
import type { Reach, Solution } from "./reach.ts";
import { insideWorkspace } from "./workspace.ts";
import { span } from "./span.ts";

/** A solution counts when forward kinematics brings it back this close. */
export const VERIFIED = { position_m: 1e-9, angle_rad: 1e-9 } as const;

const TURN = 2 * Math.PI;
/** Rounding of limits given in degrees. */
const LIMIT_SLACK_RAD = 1e-9;

/** Working memory of the solvers: one per caller. */
export interface SolverScratch { readonly raw: Float64Array; readonly q: Float64Array; readonly arm: ArmScratch; readonly pose: Pose<"base", "flange"> }
export const solverScratch = (): SolverScratch => ({ raw: new Float64Array(6 * MAX_BRANCHES), q: new Float64Array(6), arm: armScratch(), pose: identity() });

export interface SolveOptions {
  /** Solutions come nearest first, and free angles stay as they are here (rows N-16, N-18). */
  readonly near?: ArrayLike<number>;
  readonly branch?: Branch;
}

/** Every distinct branch, angles in (−π, π], limits not looked at, each verified by forward kinematics. */
export function allBranches(robot: Robot, baseFromFlange: Pose<"base", "flange">, near?: ArrayLike<number>, scratch = solverScratch()): Float64Array[] {
  if (robot.family.kind !== "ortho-parallel") return [];
  const count = solveOrthoParallel(robot.family, baseFromFlange, scratch.raw, near);
  const solutions: Float64Array[] = [];
  for (let s = 0; s < count; s++) {
    const q = scratch.raw.slice(6 * s, 6 * s + 6);
    if (isVerified(robot, q, baseFromFlange, scratch) && !solutions.some(other => sameAngles(other, q))) solutions.push(q);
  }
  return solutions;
}

/**
 * Whether a pose of the flange can be reached, by which joint angles, or why not.
 *
 * All branches of the closed form, each verified by forward kinematics to 1e-9, each expanded by ±2π where the limits
 * leave room; with `near` sorted by least total travel Σ|Δθ|.
 *
 * @see rows N-14 … N-18 and erratum E-06: the paper's 96 combinations are candidates, not solutions.
 */
export function solveAll(robot: Robot, baseFromFlange: Pose<"base", "flange">, options: SolveOptions = {}, scratch = solverScratch()): Reach {
  const flaw = poseFlaw(baseFromFlange);
  if (flaw !== undefined) return { kind: "not-a-pose", because: flaw };
  const family = robot.family;
  if (family.kind !== "ortho-parallel") return { kind: "no-solver", because: `${robot.name} has no closed-form solver.` };
  const { near, branch } = options;

  const found = allBranches(robot, baseFromFlange, near, scratch);
  if (found.length === 0) return outOfReach(robot, baseFromFlange);
  const wanted = branch === undefined ? found : found.filter(q => sameBranch(branchOfOrthoParallel(family, q), branch));
  const pool = wanted.length > 0 ? wanted : found;

  const inside: Solution[] = [];
  let considered = 0;
  for (const q of pool) {
    const named = branchOfOrthoParallel(family, q);
    for (const copy of turnsInside(robot, q)) inside.push({ q_rad: copy, branch: named });
    considered += 3 ** 6;
  }
  if (inside.length === 0) return nearestLimit(robot, pool);
  if (branch !== undefined && wanted.length === 0) return nearestLimit(robot, pool);
  const solutions = insideWorkspace(robot, inside);
  if ("kind" in solutions) return solutions;
  const sorted = near === undefined ? solutions : solutions.toSorted((a, b) => travel(a.q_rad, near) - travel(b.q_rad, near));
  return { kind: "reached", solutions: sorted, singular: inside.some(({ q_rad }) => isSingular(family, q_rad)), considered };
}

/**
 * The solution within limits that is nearest to `near` by total travel, for frame loops and dense paths; put back through
 * forward kinematics before it is handed out. Where the posture of `near` leaves its limits it may lie in another posture:
 * compare `branchOf` where that would be a jump.
 *
 * @param out      receives the joint angles; untouched when there is none. May be `near`.
 * @param scratch  with it the call allocates nothing.
 * @returns true when there is one. `solveAll` tells why not.
 */
export function nearestSolution(robot: Robot, baseFromFlange: Pose<"base", "flange">, near: ArrayLike<number>, out: Float64Array, scratch = solverScratch()): boolean {
  const family = robot.family;
  if (family.kind !== "ortho-parallel" || !isUnit(baseFromFlange)) return false;
  const raw = scratch.raw, joints = robot.arm.joints;
  const count = solveOrthoParallel(family, baseFromFlange, raw, near);
  let best = -1, least = Infinity;
  for (let s = 0; s < count; s++) {
    let total = 0;
    for (let j = 0; j < 6 && total < least; j++) {
      const limits = joints[j]!.limits, angle = nearestTurn(raw[6 * s + j]!, near[j]!, limits.lower_rad, limits.upper_rad);
      raw[6 * s + j] = angle;
      total += Math.abs(angle - near[j]!); // NaN when no turn is inside: then the comparison below is false
    }
    if (total < least) { least = total; best = s; }
  }
  if (best < 0) return false;
  for (let j = 0; j < 6; j++) scratch.q[j] = raw[6 * best + j]!;
  if (!isVerified(robot, scratch.q, baseFromFlange, scratch)) return false;
  for (let j = 0; j < 6; j++) out[j] = scratch.q[j]!;
  return true;
}

/** The angle plus whole turns that lies inside the limits and nearest to `near`; NaN when none does. */
function nearestTurn(angle: number, near: number, lower: number, upper: number): number {
  let turned = angle + TURN * Math.round((near - angle) / TURN);
  if (turned < lower - LIMIT_SLACK_RAD) turned += TURN * Math.ceil((lower - LIMIT_SLACK_RAD - turned) / TURN);
  else if (turned > upper + LIMIT_SLACK_RAD) turned -= TURN * Math.ceil((turned - upper - LIMIT_SLACK_RAD) / TURN);
  return turned >= lower - LIMIT_SLACK_RAD && turned <= upper + LIMIT_SLACK_RAD ? turned : NaN;
}

/** Total travel Σ|Δθ| [rad]. */
export function travel(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += Math.abs(a[i]! - b[i]!);
  return sum;
}

function isVerified(robot: Robot, q: Float64Array, wanted: Pose<"base", "flange">, scratch: SolverScratch): boolean {
  return posesAgree(flangePose(robot.arm, q, scratch.pose, scratch.arm), wanted, VERIFIED.position_m, VERIFIED.angle_rad);
}

/** Equal up to whole turns, so that π and −π are one solution. */
function sameAngles(a: Float64Array, b: Float64Array): boolean {
  return a.every((angle, i) => { const gap = Math.abs(angle - b[i]!); return gap < 1e-7 || Math.abs(gap - TURN) < 1e-7; });
}

/** All copies of q by whole turns of each joint that lie inside the limits. */
function turnsInside(robot: Robot, q: Float64Array): Float64Array[] {
  let copies: Float64Array[] = [new Float64Array(q.length)];
  for (let j = 0; j < q.length; j++) {
    const { lower_rad, upper_rad } = robot.arm.joints[j]!.limits;
    const next: Float64Array[] = [];
    for (let turns = Math.ceil((lower_rad - LIMIT_SLACK_RAD - q[j]!) / TURN); q[j]! + TURN * turns <= upper_rad + LIMIT_SLACK_RAD; turns++) {
      for (const copy of copies) { const more = copy.slice(); more[j] = q[j]! + TURN * turns; next.push(more); }
    }
    copies = next;
  }
  return copies;
}

/** Of the solutions outside the limits, the one whose worst joint is least beyond. */
function nearestLimit(robot: Robot, solutions: readonly Float64Array[]): Reach {
  let answer: Extract<Reach, { kind: "outside-limits" }> | undefined, least = Infinity;
  for (const q of solutions) {
    let worst = 0, joint = 0, wanted = 0, limit = 0;
    for (let j = 0; j < q.length; j++) {
      const { lower_rad, upper_rad } = robot.arm.joints[j]!.limits;
      let beyond = Infinity, angle = 0, at = 0;
      for (let turns = -2; turns <= 2; turns++) {
        const turned = q[j]! + TURN * turns, over = Math.max(lower_rad - turned, turned - upper_rad, 0);
        if (over < beyond) { beyond = over; angle = turned; at = turned < lower_rad ? lower_rad : upper_rad; }
      }
      if (beyond > worst) { worst = beyond; joint = j + 1; wanted = angle; limit = at; }
    }
    if (worst < least && joint > 0 && robot.family.kind === "ortho-parallel") {
      least = worst;
      answer = { kind: "outside-limits", joint, wanted_rad: wanted, limit_rad: limit, branch: branchOfOrthoParallel(robot.family, q) };
    }
  }
  return answer ?? { kind: "no-solver", because: "No solution of the wanted branch exists for this pose." };
}

/** Why no branch of the closed form exists: the wrist centre lies beyond the stretched or inside the folded arm. */
export function outOfReach(robot: Robot, baseFromFlange: Pose<"base", "flange">): Reach {
  const { farthest_m, nearest_m, distance_m } = span(robot, baseFromFlange);
  if (distance_m > farthest_m) return { kind: "too-far", beyond_m: distance_m - farthest_m, reach_m: farthest_m };
  return { kind: "too-near", inside_m: nearest_m - distance_m, nearest_m };
}

/** False for NaN as well. */
function isUnit({ quaternion: q }: Pose): boolean {
  const length2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  return length2 > 1 - 2e-6 && length2 < 1 + 2e-6;
}

function poseFlaw(pose: Pose): string | undefined {
  if (!pose.position.every(Number.isFinite)) return "A coordinate of the pose is not a finite number.";
  const [x, y, z, w] = pose.quaternion, length = Math.sqrt(x * x + y * y + z * z + w * w);
  if (!(Math.abs(length - 1) < 1e-6)) return `The quaternion of the pose has length ${length.toPrecision(4)}; a rotation has length 1.`;
  return undefined;
}

/** baseFromFlange of a tool tip in the world: worldFromBase⁻¹ · worldFromTcp · flangeFromTcp⁻¹ (row N-67: taught points are of the tip). */
export function flangeOfTcp(
  worldFromBase: Pose<"world", "base">, worldFromTcp: Pose<"world", "tcp">, flangeFromTcp: Pose<"flange", "tcp">, out: Pose<"base", "flange"> = identity(),
): Pose<"base", "flange"> {
  const tcpFromFlange = inverse(flangeFromTcp), baseFromTcp = compose(inverse(worldFromBase), worldFromTcp);
  return compose(baseFromTcp, tcpFromFlange, out);
}
