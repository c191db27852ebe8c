import type { Branch } from "../../kinematics/branch.ts";
import { explainReach } from "../../kinematics/explain.ts";
import { solveAll, solverScratch } from "../../kinematics/inverse.ts";
import { PoseFit, type PoseFitOptions } from "../../kinematics/pose-fit.ts";
import type { Reach } from "../../kinematics/reach.ts";
import { span } from "../../kinematics/span.ts";
import type { Robot } from "../../model/robot.ts";
import { compose, identity, type Pose } from "../../spatial/pose.ts";
import { radians } from "../../spatial/units.ts";
import { distance } from "../../spatial/vector.ts";
import { changedPose, effortOf, type PoseChange } from "./change.ts";
import { leastChange, levelShift, LIFT, SPIN, TILT, type ChangeSearch, type Least } from "./least-change.ts";

/** A repaired pose leaves every joint this much room to its limits [rad]. */
export const REPAIR_ROOM_RAD = radians(1);

/** Why a pose cannot be: what binds, in numbers. */
export type PoseCause =
  | { readonly kind: "free" }
  /** Too far, too near, outside limits by how much, not so turned, beyond the declared workspace. */
  | { readonly kind: "reach"; readonly reach: Exclude<Reach, { kind: "reached" }> }
  /** The wanted branch leaves its limits; another one would not. */
  | {
      readonly kind: "branch";
      readonly reach: Exclude<Reach, { kind: "reached" }>;
      readonly wanted: Branch;
      readonly instead: Branch;
    }
  /** Every posture that reaches it touches something; the first of them, nearest to `near`. */
  | { readonly kind: "collision"; readonly q_rad: Float64Array; readonly postures: number };

export interface PoseQuestion extends Pick<PoseFitOptions, "accepts"> {
  /** The posture the robot comes from; home by default. */
  readonly near?: ArrayLike<number>;
  /** The branch it was taught with. */
  readonly branch?: Branch;
}

/** What binds a pose of the flange; "free" when nothing does. */
export function explainPose(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  question: PoseQuestion = {},
): PoseCause {
  const near = question.near ?? robot.home_rad;
  const { branch, accepts } = question;
  const scratch = solverScratch();
  const reach = solveAll(robot, baseFromFlange, branch === undefined ? { near } : { near, branch }, scratch);
  if (reach.kind === "reached") {
    if (accepts === undefined || reach.solutions.some(({ q_rad }) => accepts(q_rad))) return { kind: "free" };
    return { kind: "collision", q_rad: reach.solutions[0]!.q_rad, postures: reach.solutions.length };
  }
  if (branch !== undefined) {
    const other = solveAll(robot, baseFromFlange, { near }, scratch);
    const instead = other.kind === "reached" ? other.solutions[0]!.branch : undefined;
    if (instead !== undefined) return { kind: "branch", reach, wanted: branch, instead };
  }
  return { kind: "reach", reach };
}

const branchWords = ({ shoulder, elbow, wrist }: Branch): string =>
  `shoulder ${shoulder}, elbow ${elbow}, wrist ${wrist}`;

/** One sentence with the numbers of the cause. */
export function explainCause(cause: PoseCause): string {
  switch (cause.kind) {
    case "free":
      return "The pose can be reached.";
    case "reach":
      return explainReach(cause.reach);
    case "branch":
      return [
        `With ${branchWords(cause.wanted)}: ${explainReach(cause.reach)}`,
        `With ${branchWords(cause.instead)} it can be reached.`,
      ].join(" ");
    case "collision":
      return cause.postures === 1
        ? "The one posture that reaches the pose touches something."
        : `All ${cause.postures} postures that reach the pose touch something.`;
  }
}

/** A change with which a pose can be reached, every joint `REPAIR_ROOM_RAD` inside its limits. */
export interface PoseRepair {
  readonly change: PoseChange;
  /** How far it turns or moves [rad or m]. */
  readonly amount: number;
  /** See `effortOf`. */
  readonly effort: number;
  readonly baseFromTcp: Pose<"base", "tcp">;
  /** A posture that reaches it. */
  readonly q_rad: Float64Array;
}

/**
 * The least change of every kind (spin, tilt, shift) that makes a pose possible, the smallest effort first; at most
 * three. Kinds that cannot help are left out: a pose that is too far away by more than a turn of the tool brings it
 * nearer is not turned.
 */
export function repairPose(
  robot: Robot,
  baseFromTcp: Pose<"base", "tcp">,
  tcpFromFlange: Pose<"tcp", "flange">,
  options: Pick<PoseFitOptions, "accepts"> = {},
): readonly PoseRepair[] {
  const fit = new PoseFit(robot, { ...options, room_rad: REPAIR_ROOM_RAD });
  const changed = identity<"base", "tcp">();
  const flange = identity<"base", "flange">();
  const miss = (change: PoseChange): number =>
    fit.miss(compose(changedPose(baseFromTcp, change, changed), tcpFromFlange, flange));
  const missing_m = missing(robot, compose(baseFromTcp, tcpFromFlange));
  const found: PoseRepair[] = [];
  const take = (least: Least | undefined): void => {
    if (least === undefined || miss(least.change) !== 0) return;
    found.push({
      ...least,
      effort: effortOf(least.change),
      baseFromTcp: changedPose(baseFromTcp, least.change),
      q_rad: fit.q_rad.slice(),
    });
  };
  const wrist_m = distanceOfWrist(robot, tcpFromFlange);
  for (const search of [SPIN, TILT] satisfies ChangeSearch[])
    if (missing_m <= 2 * wrist_m * Math.sin(search.most / 2)) take(leastChange(search, miss));
  const outward = Math.atan2(baseFromTcp.position[1], baseFromTcp.position[0]);
  const level = leastChange(levelShift(outward), miss, missing_m);
  const lift = leastChange({ ...LIFT, most: Math.min(LIFT.most, level?.amount ?? LIFT.most) }, miss, missing_m);
  take(lift !== undefined && !(level !== undefined && level.amount <= lift.amount) ? lift : level);
  return found.sort((a, b) => a.effort - b.effort);
}

/** How far the wrist has to come at least before the arm's lengths allow the pose [m]. */
export function missing(robot: Robot, baseFromFlange: Pose<"base", "flange">): number {
  if (robot.family.kind !== "ortho-parallel") return 0;
  const { distance_m, nearest_m, farthest_m } = span(robot, baseFromFlange);
  return Math.max(0, distance_m - farthest_m, nearest_m - distance_m) * 0.999;
}

/** Upper bound of the distance between the tool's tip and where the last three axes meet [m]. */
function distanceOfWrist(robot: Robot, tcpFromFlange: Pose<"tcp", "flange">): number {
  if (robot.family.kind !== "ortho-parallel") return Infinity;
  const { c4_m, formulaFromFlange } = robot.family;
  return distance([0, 0, 0], tcpFromFlange.position) + Math.abs(c4_m) + distance([0, 0, 0], formulaFromFlange.position);
}

/** Branches that reach a pose inside the limits, other than that of `near`. */
export function otherBranches(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  near: ArrayLike<number>,
): readonly Branch[] {
  const reach = solveAll(robot, baseFromFlange, { near });
  if (reach.kind !== "reached") return [];
  const names = new Map<string, Branch>();
  for (const { branch } of reach.solutions) if (branch !== undefined) names.set(branchWords(branch), branch);
  return [...names.values()];
}
