import type { Robot } from "../model/robot.ts";
import { identity, posesAgree, type Pose } from "../spatial/pose.ts";
import { wrapAngle } from "../spatial/units.ts";
import { armScratch, flangePose, type ArmScratch } from "./forward.ts";
import { MAX_GENERAL_SIX, solveGeneralSix } from "./general-six-search.ts";
import { generalSixScratch, type GeneralSixScratch } from "./general-six.ts";
import { dampedScratch, type DampedScratch } from "./numeric/damped-scratch.ts";
import { mend, mendScratch, type MendScratch } from "./mend.ts";
import { solveOrthoParallel } from "./ortho-parallel.ts";
import { refine, refineScratch, type HeldElbow, type RefineScratch } from "./refine.ts";
import { elbowOfSphericalSeven, solveSphericalSeven } from "./spherical-seven.ts";
import { solveThreeParallel } from "./three-parallel.ts";

/** A solution counts when forward kinematics brings it back this close. */
export const VERIFIED = { position_m: 1e-9, angle_rad: 1e-9 } as const;
/**
 * A candidate worse than this is refined: the arm's file may round its right angles, and a searched root is only near.
 */
const EXACT = 1e-12;
/** Refinement of an answer that is verified already turns no joint that is not free by more than this [rad]. */
const FREE_RAD = 1e-2;

/** Working memory of the solvers: one per caller, for arms of any family one after another. */
export interface SolverScratch {
  /** Candidates one after another, as many angles each as the arm has joints. */
  readonly raw: Float64Array;
  /** One posture; as long as the arm last asked for has joints. */
  q: Float64Array;
  readonly arm: ArmScratch;
  readonly pose: Pose<"base", "flange">;
  readonly refine: RefineScratch;
  readonly six: GeneralSixScratch;
  readonly start: Float64Array;
  readonly mend: MendScratch;
  /** Of arms without a closed form; made when first needed. */
  damped: DampedScratch | null;
  /** The elbow angle that seven-joint postures are mended to. */
  held: HeldElbow | null;
}

export const solverScratch = (): SolverScratch => ({
  raw: new Float64Array(6 * MAX_GENERAL_SIX),
  q: new Float64Array(6),
  arm: armScratch(),
  pose: identity(),
  refine: refineScratch(),
  six: generalSixScratch(),
  start: new Float64Array(6),
  mend: mendScratch(),
  held: null,
  damped: null,
});

/**
 * Candidates of the arm's own family into `scratch.raw`, angles in (−π, π], limits not looked at; each is to be
 * settled.
 *
 * @param near       angles that free ones are taken from; for seven joints also the elbow angle, unless `elbow_rad` is
 *   given.
 * @param elbow_rad  of seven joints; 0 without `near`.
 * @returns their number. Allocates nothing, except for six joints without a closed form.
 */
export function candidates(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  near: ArrayLike<number> | undefined,
  elbow_rad: number | undefined,
  scratch: SolverScratch,
): number {
  const family = robot.family;
  switch (family.kind) {
    case "ortho-parallel":
      return solveOrthoParallel(family, baseFromFlange, scratch.raw, near);
    case "three-parallel":
      return solveThreeParallel(family, baseFromFlange, scratch.raw, near);
    case "general-6r":
      return solveGeneralSix(family, baseFromFlange, scratch.raw, scratch.six);
    case "spherical-seven": {
      const elbow = elbow_rad ?? (near === undefined ? 0 : elbowOfSphericalSeven(family, near));
      const count = solveSphericalSeven(family, baseFromFlange, elbow, scratch.raw, near);
      if (family.deviation_m === 0) return count;
      if (scratch.held?.geometry !== family) scratch.held = { geometry: family, elbow_rad: elbow };
      scratch.held.elbow_rad = elbow;
      for (let s = 0; s < count; s++)
        mend(robot.arm, baseFromFlange, scratch.held, scratch.raw, s, count, scratch.mend, scratch.refine);
      return count;
    }
    case "general":
      return 0;
  }
}

/**
 * The posture at `scratch.raw[s]`, moved to `scratch.q`, refined where it needs it. False when it does not meet the
 * pose to 1e-9.
 */
export function settle(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  s: number,
  scratch: SolverScratch,
): boolean {
  const n = robot.arm.joints.length;
  if (scratch.q.length !== n) scratch.q = new Float64Array(n);
  const q = scratch.q;
  for (let j = 0; j < n; j++) q[j] = scratch.raw[n * s + j]!;
  return settled(robot, baseFromFlange, q, scratch);
}

/** The same for angles that lie anywhere; they are overwritten by better ones. */
export function settled(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  q: Float64Array,
  scratch: SolverScratch,
): boolean {
  flangePose(robot.arm, q, scratch.pose, scratch.arm);
  // The closed form of an ortho-parallel arm is as exact as its arm, and seven joints have been mended.
  if (robot.family.kind === "ortho-parallel" || robot.family.kind === "spherical-seven")
    return posesAgree(scratch.pose, baseFromFlange, VERIFIED.position_m, VERIFIED.angle_rad);
  if (posesAgree(scratch.pose, baseFromFlange, EXACT, EXACT)) return true;
  const verified = posesAgree(scratch.pose, baseFromFlange, VERIFIED.position_m, VERIFIED.angle_rad);
  const { start } = scratch;
  for (let j = 0; j < q.length; j++) start[j] = q[j]!;
  const met = refine(robot.arm, q, baseFromFlange, scratch.refine) < VERIFIED.position_m;
  // On a singularity the last digits of a pose would turn free joints anywhere: they stay where they were chosen.
  if (verified && !(met && nearby(q, start))) for (let j = 0; j < q.length; j++) q[j] = start[j]!;
  return met || verified;
}

function nearby(a: Float64Array, b: Float64Array): boolean {
  for (let j = 0; j < a.length; j++) if (!(Math.abs(a[j]! - b[j]!) < FREE_RAD)) return false;
  return true;
}

/** The scratch of damped least squares for arms of so many joints. */
export function dampedFor(joints: number, scratch: SolverScratch): DampedScratch {
  if (scratch.damped?.q.length !== joints) scratch.damped = dampedScratch(joints);
  return scratch.damped ?? dampedScratch(joints);
}

/** The elbow angle of a seven-joint posture [rad, in (−π, π]]; undefined for an arm without one. */
export function elbowOf(robot: Robot, q_rad: ArrayLike<number>): number | undefined {
  return robot.family.kind === "spherical-seven" ? wrapAngle(elbowOfSphericalSeven(robot.family, q_rad)) : undefined;
}
