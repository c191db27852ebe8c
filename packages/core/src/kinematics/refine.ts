import type { SerialArm } from "../model/arm.ts";
import type { SphericalSevenGeometry } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { wrapAngle } from "../spatial/units.ts";
import { flangePose } from "./forward.ts";
import { jacobian, jacobianScratch, type JacobianScratch } from "./jacobian.ts";
import { elbowOfSphericalSeven } from "./spherical-seven.ts";

/** What a seventh joint is for: the elbow angle that is to be kept. */
export interface HeldElbow {
  readonly geometry: SphericalSevenGeometry;
  elbow_rad: number;
}

/** Working memory of `refine`: one per caller; grows to the arm's joints when first used. */
export interface RefineScratch {
  jacobian: JacobianScratch;
  rows: Float64Array;
  system: Float64Array;
  readonly error: Float64Array;
  readonly step: Float64Array;
  trial: Float64Array;
}
export const refineScratch = (joints = 6): RefineScratch => ({
  jacobian: jacobianScratch(joints),
  rows: new Float64Array(6 * joints),
  system: new Float64Array(joints * (joints + 1)),
  error: new Float64Array(7),
  step: new Float64Array(7),
  trial: new Float64Array(joints),
});

/** An answer this close [m, rad] is not worth another step. */
const GOOD_ENOUGH = 1e-14;
const MOST_STEPS = 14;
const MOST_HALVINGS = 6;
/** No step turns a joint further than this [rad]: beyond it the linear law means nothing. */
const LONGEST_STEP_RAD = 0.2;
/** A pivot this small against the largest has no direction to give. */
const NO_PIVOT = 1e-13;
/** Between two elbow angles that give its gradient [rad]. */
const GRADIENT_STEP_RAD = 1e-6;

/**
 * Joint angles close to a solution, brought onto it by Newton's method.
 *
 *   q ← q + J⁻¹ e,   e = (p* − p;  axis · angle of R* Rᵀ;  ψ* − ψ for seven joints)
 *
 * Each step must lessen |e|, else it is halved: the answer is never worse than the start, and never NaN.
 *
 * @param q        six angles [rad], or seven with `held`; overwritten with better ones.
 * @param scratch  with it the call allocates nothing once it has seen an arm of n joints.
 * @returns what is left: the largest of distance [m], angle [rad] and elbow angle [rad]. Infinity for an arm of other
 *   joints.
 */
export function refine(
  arm: SerialArm,
  q: Float64Array,
  wanted: Pose<"base", "flange">,
  scratch: RefineScratch,
  held: HeldElbow | null = null,
): number {
  const n = arm.joints.length;
  if (n !== (held === null ? 6 : 7)) return Infinity;
  if (scratch.trial.length !== n) {
    scratch.jacobian = jacobianScratch(n);
    scratch.rows = new Float64Array(6 * n);
    scratch.system = new Float64Array(n * (n + 1));
    scratch.trial = new Float64Array(n);
  }
  const { rows, error, step, trial } = scratch;
  jacobian(arm, q, null, rows, scratch.jacobian);
  let left = miss(scratch.jacobian.baseFromFlange, wanted, q, held, error);
  for (let k = 0; k < MOST_STEPS && left > GOOD_ENOUGH; k++) {
    if (!solveStep(rows, n, q, held, scratch)) return left;
    let longest = 0;
    for (let j = 0; j < n; j++) longest = Math.max(longest, Math.abs(step[j]!));
    const factor = longest > LONGEST_STEP_RAD ? LONGEST_STEP_RAD / longest : 1;
    for (let j = 0; j < n; j++) trial[j] = q[j]! + factor * step[j]!;
    let better = false;
    for (let half = 0; half < MOST_HALVINGS; half++) {
      const after = miss(
        flangePose(arm, trial, scratch.jacobian.baseFromFlange, scratch.jacobian.arm),
        wanted,
        trial,
        held,
        error,
      );
      if (after < left) {
        better = true;
        left = after;
        break;
      }
      for (let j = 0; j < n; j++) trial[j] = 0.5 * (trial[j]! + q[j]!);
    }
    if (!better) return left;
    q.set(trial);
    if (left > GOOD_ENOUGH) jacobian(arm, q, null, rows, scratch.jacobian);
  }
  return left;
}

function miss(is: Pose, wanted: Pose, q: Float64Array, held: HeldElbow | null, error: Float64Array): number {
  const left = errorTwist(is, wanted, error);
  if (held === null) return left;
  error[6] = wrapAngle(held.elbow_rad - elbowOfSphericalSeven(held.geometry, q));
  return Math.max(left, Math.abs(error[6]));
}

/** error = (p* − p; rotation vector of R* Rᵀ, to third order); returns the larger of its two lengths. */
export function errorTwist(is: Pose, wanted: Pose, error: Float64Array): number {
  const p = is.position;
  const o = wanted.position;
  const a = wanted.quaternion;
  const b = is.quaternion;
  const w = a[3] * b[3] + a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const sign = w < 0 ? -2 : 2;
  const dx = o[0] - p[0];
  const dy = o[1] - p[1];
  const dz = o[2] - p[2];
  const rx = sign * (b[3] * a[0] - a[3] * b[0] - a[1] * b[2] + a[2] * b[1]);
  const ry = sign * (b[3] * a[1] - a[3] * b[1] - a[2] * b[0] + a[0] * b[2]);
  const rz = sign * (b[3] * a[2] - a[3] * b[2] - a[0] * b[1] + a[1] * b[0]);
  error[0] = dx;
  error[1] = dy;
  error[2] = dz;
  error[3] = rx;
  error[4] = ry;
  error[5] = rz;
  return Math.sqrt(Math.max(dx * dx + dy * dy + dz * dz, rx * rx + ry * ry + rz * rz));
}

/**
 * step ← J⁻¹ e by elimination with pivots; the elbow's gradient is J's seventh row. False where there is no such step.
 */
function solveStep(
  rows: Float64Array,
  n: number,
  q: Float64Array,
  held: HeldElbow | null,
  { system, error, step }: RefineScratch,
): boolean {
  const m = n + 1;
  for (let i = 0; i < 6; i++) {
    for (let j = 0; j < n; j++) system[i * m + j] = rows[i * n + j]!;
    system[i * m + n] = error[i]!;
  }
  if (held !== null) {
    for (let j = 0; j < n; j++) {
      if (j > 3) {
        system[6 * m + j] = 0;
        continue;
      }
      const kept = q[j]!;
      q[j] = kept + GRADIENT_STEP_RAD;
      const after = elbowOfSphericalSeven(held.geometry, q);
      q[j] = kept - GRADIENT_STEP_RAD;
      const before = elbowOfSphericalSeven(held.geometry, q);
      q[j] = kept;
      system[6 * m + j] = wrapAngle(after - before) / (2 * GRADIENT_STEP_RAD);
    }
    system[6 * m + n] = error[6]!;
  }
  let largest = 0;
  for (let col = 0; col < n; col++) {
    let pivot = col;
    for (let i = col + 1; i < n; i++)
      if (Math.abs(system[i * m + col]!) > Math.abs(system[pivot * m + col]!)) pivot = i;
    const size = Math.abs(system[pivot * m + col]!);
    largest = Math.max(largest, size);
    if (!(size > NO_PIVOT * largest)) return false;
    if (pivot !== col)
      for (let j = col; j < m; j++) {
        const swap = system[col * m + j]!;
        system[col * m + j] = system[pivot * m + j]!;
        system[pivot * m + j] = swap;
      }
    for (let i = col + 1; i < n; i++) {
      const factor = system[i * m + col]! / system[col * m + col]!;
      if (factor !== 0) for (let j = col + 1; j < m; j++) system[i * m + j]! -= factor * system[col * m + j]!;
    }
  }
  for (let i = n - 1; i >= 0; i--) {
    let sum = system[i * m + n]!;
    for (let j = i + 1; j < n; j++) sum -= system[i * m + j]! * step[j]!;
    step[i] = sum / system[i * m + i]!;
  }
  return true;
}
