import type { Robot } from "../model/robot.ts";
import { compose, identity, inverse, type Pose } from "../spatial/pose.ts";
import { branchOf, sameBranch, type Branch } from "./branch.ts";
import {
  candidates,
  dampedFor,
  elbowOf,
  settle,
  settled,
  solverScratch,
  VERIFIED,
  type SolverScratch,
} from "./candidates.ts";
import { nearestElbow } from "./elbow.ts";
import { nearestDamped } from "./numeric/damped.ts";
import { numericBranches, numericReach } from "./numeric-reach.ts";
import { outOfReach } from "./out-of-reach.ts";
import type { Reach, Solution } from "./reach.ts";
import { isSingularConfiguration } from "./singularity.ts";
import { LIMIT_SLACK_RAD, nearestTurn, revolutionsInside } from "./turns.ts";
import { insideWorkspace } from "./workspace.ts";

export { elbowOf, outOfReach, solverScratch, VERIFIED, type SolverScratch };

const TURN = 2 * Math.PI;
/** Two answers this close are one. Where two postures fall together, no arithmetic tells them apart more finely. */
const SAME_RAD = 1e-7;
const SAME_SEARCHED_RAD = 1e-6;
/** A pose this near to the last one is followed, not searched for. */
const FOLLOWED_RAD = 0.05;

export interface SolveOptions {
  /** Solutions come nearest first, and free angles stay as they are here (rows N-16, N-18). */
  readonly near?: ArrayLike<number>;
  readonly branch?: Branch;
  /**
   * Elbow angle of a seven-joint arm [rad]; else that of the branch, else that of `near`, else 0 or the nearest to
   * these that the limits allow.
   */
  readonly elbow_rad?: number;
}

/**
 * Every distinct branch, angles in (−π, π], limits not looked at, each verified by forward kinematics; of seven joints
 * those of one elbow angle. Of an arm without a closed form those that damped least squares finds inside the limits,
 * maybe not all.
 */
export function allBranches(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  near?: ArrayLike<number>,
  scratch = solverScratch(),
  elbow_rad?: number,
): Float64Array[] {
  if (robot.family.kind === "general")
    return poseFlaw(baseFromFlange) === undefined ? [...numericBranches(robot, baseFromFlange, near).found] : [];
  const count = candidates(robot, baseFromFlange, near, elbow_rad, scratch);
  const same = robot.family.kind === "general-6r" ? SAME_SEARCHED_RAD : SAME_RAD;
  const solutions: Float64Array[] = [];
  for (let s = 0; s < count; s++) {
    if (settle(robot, baseFromFlange, s, scratch) && !solutions.some(other => sameAngles(other, scratch.q, same)))
      solutions.push(scratch.q.map(inOneTurn));
  }
  return solutions;
}

/**
 * Whether a pose of the flange can be reached, by which joint angles, or why not.
 *
 * All branches of the arm's family, each verified by forward kinematics to 1e-9, each expanded by ±2π where the limits
 * leave room; with `near` sorted by least total travel Σ|Δθ|. A seven-joint arm whose limits do not allow the elbow
 * angle it would keep takes the nearest they allow; one that was asked for by `elbow_rad` is never changed.
 *
 * @see rows N-14 … N-18 and erratum E-06: the paper's 96 combinations are candidates, not solutions.
 */
export function solveAll(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  options: SolveOptions = {},
  scratch = solverScratch(),
): Reach {
  const flaw = poseFlaw(baseFromFlange);
  if (flaw !== undefined) return { kind: "not-a-pose", because: flaw };
  const { near, branch } = options;
  if (robot.family.kind === "general") return insideDeclared(robot, numericReach(robot, baseFromFlange, near));
  const asked = options.elbow_rad ?? branch?.elbow_rad;
  const found = allBranches(robot, baseFromFlange, near, scratch, asked);
  if (found.length === 0) return outOfReach(robot, baseFromFlange);
  const first = withinLimits(robot, found, branch);
  if (first.inside.length === 0 && robot.family.kind === "spherical-seven" && options.elbow_rad === undefined) {
    const elbow = nearestElbow(
      robot,
      baseFromFlange,
      asked ?? (near === undefined ? 0 : (elbowOf(robot, near) ?? 0)),
      near,
      scratch,
    );
    if (elbow !== undefined)
      return answer(robot, withinLimits(robot, allBranches(robot, baseFromFlange, near, scratch, elbow), branch), near);
  }
  return answer(robot, first, near);
}

function insideDeclared(robot: Robot, reach: Reach): Reach {
  if (reach.kind !== "reached") return reach;
  const solutions = insideWorkspace(robot, reach.solutions);
  return "kind" in solutions ? solutions : { ...reach, solutions };
}

interface Sorted {
  readonly inside: Solution[];
  readonly pool: readonly Float64Array[];
}

/** The wanted branch, or all where it is not among them, with all copies by whole turns inside the limits. */
function withinLimits(robot: Robot, found: readonly Float64Array[], branch: Branch | undefined): Sorted {
  const wanted =
    branch === undefined
      ? found
      : found.filter(q => {
          const named = branchOf(robot, q);
          return named !== undefined && sameBranch(named, branch);
        });
  if (wanted.length === 0) return { inside: [], pool: found };
  const inside: Solution[] = [];
  for (const q of wanted) {
    const named = branchOf(robot, q);
    for (const copy of revolutionsInside(robot, q)) inside.push({ q_rad: copy, branch: named });
  }
  return { inside, pool: wanted };
}

function answer(robot: Robot, { inside, pool }: Sorted, near: ArrayLike<number> | undefined): Reach {
  if (inside.length === 0) return nearestLimit(robot, pool);
  const solutions = insideWorkspace(robot, inside);
  if ("kind" in solutions) return solutions;
  const sorted =
    near === undefined ? solutions : solutions.toSorted((a, b) => travel(a.q_rad, near) - travel(b.q_rad, near));
  return {
    kind: "reached",
    solutions: sorted,
    singular: pool.some(q => isSingularConfiguration(robot, q)),
    considered: pool.length * 3 ** robot.arm.joints.length,
  };
}

/**
 * The solution within limits that is nearest to `near` by total travel, for frame loops and dense paths; put back
 * through forward kinematics before it is handed out. Where the posture of `near` leaves its limits it may lie in
 * another posture: compare `branchOf` where that would be a jump.
 *
 * A seven-joint arm keeps the elbow angle of `near`, or takes the nearest one that its limits allow.
 *
 * @param out      receives the joint angles; untouched when there is none. May be `near`.
 * @param scratch  with it the call allocates nothing, except for six joints without a closed form.
 * @returns true when there is one. `solveAll` tells why not.
 */
export function nearestSolution(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  near: ArrayLike<number>,
  out: Float64Array,
  scratch = solverScratch(),
): boolean {
  if (!isUnit(baseFromFlange)) return false;
  if (robot.family.kind === "general")
    return nearestDamped(robot.arm, baseFromFlange, near, out, dampedFor(robot.arm.joints.length, scratch));
  if (
    (robot.family.kind === "general-6r" || robot.family.kind === "three-parallel") &&
    follows(robot, baseFromFlange, near, scratch)
  ) {
    out.set(scratch.q);
    return true;
  }
  if (nearestOf(robot, baseFromFlange, near, undefined, out, scratch)) return true;
  if (robot.family.kind !== "spherical-seven") return false;
  const elbow = nearestElbow(robot, baseFromFlange, elbowOf(robot, near) ?? 0, near, scratch);
  return elbow !== undefined && nearestOf(robot, baseFromFlange, near, elbow, out, scratch);
}

function nearestOf(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  near: ArrayLike<number>,
  elbow_rad: number | undefined,
  out: Float64Array,
  scratch: SolverScratch,
): boolean {
  const raw = scratch.raw;
  const joints = robot.arm.joints;
  const n = joints.length;
  const count = candidates(robot, baseFromFlange, near, elbow_rad, scratch);
  // A candidate that does not meet its pose once refined is passed over, and the next nearest looked at.
  for (let tried = 0; tried < count; tried++) {
    let best = -1;
    let least = Infinity;
    for (let s = 0; s < count; s++) {
      let total = 0;
      for (let j = 0; j < n && total < least; j++) {
        const limits = joints[j]!.limits;
        const angle = nearestTurn(raw[n * s + j]!, near[j]!, limits.lower_rad, limits.upper_rad);
        raw[n * s + j] = angle;
        total += Math.abs(angle - near[j]!); // NaN when no turn is inside: then the comparison below is false
      }
      if (total < least) {
        least = total;
        best = s;
      }
    }
    if (best < 0) return false;
    if (settle(robot, baseFromFlange, best, scratch)) {
      for (let j = 0; j < n; j++) out[j] = scratch.q[j]!;
      return true;
    }
    raw[n * best] = NaN;
  }
  return false;
}

/** Newton's method from `near`, where the way is short and stays inside the limits; the answer is in `scratch.q`. */
function follows(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  near: ArrayLike<number>,
  scratch: SolverScratch,
): boolean {
  const joints = robot.arm.joints;
  const n = joints.length;
  if (scratch.q.length !== n) scratch.q = new Float64Array(n);
  const q = scratch.q;
  for (let j = 0; j < n; j++) q[j] = near[j]!;
  if (!settled(robot, baseFromFlange, q, scratch) || !(travel(q, near) < FOLLOWED_RAD)) return false;
  for (let j = 0; j < n; j++) {
    const { lower_rad, upper_rad } = joints[j]!.limits;
    if (!(q[j]! >= lower_rad - LIMIT_SLACK_RAD && q[j]! <= upper_rad + LIMIT_SLACK_RAD)) return false;
  }
  return true;
}

/** Total travel Σ|Δθ| [rad]. */
export function travel(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += Math.abs(a[i]! - b[i]!);
  return sum;
}

/** Equal up to whole turns, so that π and −π are one solution. */
function sameAngles(a: Float64Array, b: Float64Array, same_rad: number): boolean {
  return a.every((angle, i) => {
    const gap = Math.abs(angle - b[i]!) % TURN;
    return gap < same_rad || TURN - gap < same_rad;
  });
}

/** Refinement may step over the seam. */
const inOneTurn = (angle: number): number =>
  angle > Math.PI ? angle - TURN : angle <= -Math.PI ? angle + TURN : angle;

/** Of the solutions outside the limits, the one whose worst joint is least beyond. */
function nearestLimit(robot: Robot, solutions: readonly Float64Array[]): Reach {
  let answer: Extract<Reach, { kind: "outside-limits" }> | undefined;
  let least = Infinity;
  for (const q of solutions) {
    let worst = 0;
    let joint = 0;
    let wanted = 0;
    let limit = 0;
    for (let j = 0; j < q.length; j++) {
      const { lower_rad, upper_rad } = robot.arm.joints[j]!.limits;
      let beyond = Infinity;
      let angle = 0;
      let at = 0;
      for (let turns = -2; turns <= 2; turns++) {
        const turned = q[j]! + TURN * turns;
        const over = Math.max(lower_rad - turned, turned - upper_rad, 0);
        if (over < beyond) {
          beyond = over;
          angle = turned;
          at = turned < lower_rad ? lower_rad : upper_rad;
        }
      }
      if (beyond > worst) {
        worst = beyond;
        joint = j + 1;
        wanted = angle;
        limit = at;
      }
    }
    if (worst < least && joint > 0) {
      least = worst;
      answer = { kind: "outside-limits", joint, wanted_rad: wanted, limit_rad: limit, branch: branchOf(robot, q) };
    }
  }
  return answer ?? { kind: "no-solver", because: "No solution of the wanted branch exists for this pose." };
}

/** False for NaN as well. */
function isUnit({ quaternion: q }: Pose): boolean {
  const length2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  return length2 > 1 - 2e-6 && length2 < 1 + 2e-6;
}

function poseFlaw(pose: Pose): string | undefined {
  if (!pose.position.every(Number.isFinite)) return "A coordinate of the pose is not a finite number.";
  const [x, y, z, w] = pose.quaternion;
  const length = Math.sqrt(x * x + y * y + z * z + w * w);
  if (!(Math.abs(length - 1) < 1e-6))
    return `The quaternion of the pose has length ${length.toPrecision(4)}; a rotation has length 1.`;
  return undefined;
}

/**
 * baseFromFlange of a tool tip in the world: worldFromBase⁻¹ · worldFromTcp · flangeFromTcp⁻¹ (row N-67: taught points
 * are of the tip).
 */
export function flangeOfTcp(
  worldFromBase: Pose<"world", "base">,
  worldFromTcp: Pose<"world", "tcp">,
  flangeFromTcp: Pose<"flange", "tcp">,
  out: Pose<"base", "flange"> = identity(),
): Pose<"base", "flange"> {
  const tcpFromFlange = inverse(flangeFromTcp);
  const baseFromTcp = compose(inverse(worldFromBase), worldFromTcp);
  return compose(baseFromTcp, tcpFromFlange, out);
}
