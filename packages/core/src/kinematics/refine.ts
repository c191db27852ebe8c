import type { SerialArm } from "../robots/arm.ts";
import type { Pose } from "../spatial/pose.ts";
import { flangePose } from "./forward.ts";
import { jacobian, jacobianScratch, type JacobianScratch } from "./jacobian.ts";

/** Working memory of `refine`: one per caller; grows to the arm's joints when first used. */
export interface RefineScratch { jacobian: JacobianScratch; rows: Float64Array; readonly system: Float64Array; readonly error: Float64Array; readonly step: Float64Array; trial: Float64Array }
export const refineScratch = (joints = 6): RefineScratch => ({
  jacobian: jacobianScratch(joints), rows: new Float64Array(6 * joints), system: new Float64Array(42), error: new Float64Array(6), step: new Float64Array(6), trial: new Float64Array(joints),
});

/** An answer this close [m, rad] is not worth another step. */
const GOOD_ENOUGH = 1e-14;
const MOST_STEPS = 12, MOST_HALVINGS = 6;
/** No step turns a joint further than this [rad]: beyond it the linear law means nothing. */
const LONGEST_STEP_RAD = 0.2;
/** A pivot this small against the largest has no direction to give. */
const NO_PIVOT = 1e-13;

/**
 * Joint angles close to a solution, brought onto it by Newton's method.
 *
 *   q ← q + Jᵀ (J Jᵀ)⁻¹ e,  which is J⁻¹ e for six joints;   e = (p* − p;  axis · angle of R* Rᵀ)
 *
 * Each step must lessen |e|, else it is halved: the answer is never worse than the start, and never NaN.
 *
 * @param q        n angles [rad], overwritten with better ones.
 * @param scratch  with it the call allocates nothing once it has seen an arm of n joints.
 * @returns what is left: the larger of distance [m] and angle [rad].
 */
export function refine(arm: SerialArm, q: Float64Array, wanted: Pose<"base", "flange">, scratch: RefineScratch): number {
  const n = arm.joints.length;
  if (scratch.trial.length !== n) { scratch.jacobian = jacobianScratch(n); scratch.rows = new Float64Array(6 * n); scratch.trial = new Float64Array(n); }
  const { rows, error, step, trial } = scratch;
  jacobian(arm, q, null, rows, scratch.jacobian);
  let left = poseError(scratch.jacobian.baseFromFlange, wanted, error);
  for (let k = 0; k < MOST_STEPS && left > GOOD_ENOUGH; k++) {
    if (!solveStep(rows, n, scratch)) return left;
    let longest = 0;
    for (let j = 0; j < n; j++) {
      let sum = 0;
      if (n === 6) sum = step[j]!; else for (let row = 0; row < 6; row++) sum += rows[row * n + j]! * step[row]!;
      trial[j] = sum; longest = Math.max(longest, Math.abs(sum));
    }
    let factor = longest > LONGEST_STEP_RAD ? LONGEST_STEP_RAD / longest : 1, better = false;
    for (let j = 0; j < n; j++) trial[j] = q[j]! + factor * trial[j]!;
    for (let half = 0; half < MOST_HALVINGS && !better; half++) {
      const after = poseError(flangePose(arm, trial, scratch.jacobian.baseFromFlange, scratch.jacobian.arm), wanted, error);
      if (after < left) { better = true; left = after; break; }
      factor *= 0.5;
      for (let j = 0; j < n; j++) trial[j] = 0.5 * (trial[j]! + q[j]!);
    }
    if (!better) return left;
    q.set(trial);
    if (left > GOOD_ENOUGH) { jacobian(arm, q, null, rows, scratch.jacobian); left = poseError(scratch.jacobian.baseFromFlange, wanted, error); }
  }
  return left;
}

/** error = (p* − p; rotation vector of R* Rᵀ, to third order); returns the larger of its two lengths. */
export function poseError(is: Pose, wanted: Pose, error: Float64Array): number {
  const p = is.position, o = wanted.position, a = wanted.quaternion, b = is.quaternion;
  const w = a[3] * b[3] + a[0] * b[0] + a[1] * b[1] + a[2] * b[2], sign = w < 0 ? -2 : 2;
  const dx = o[0] - p[0], dy = o[1] - p[1], dz = o[2] - p[2];
  const rx = sign * (b[3] * a[0] - a[3] * b[0] - a[1] * b[2] + a[2] * b[1]);
  const ry = sign * (b[3] * a[1] - a[3] * b[1] - a[2] * b[0] + a[0] * b[2]);
  const rz = sign * (b[3] * a[2] - a[3] * b[2] - a[0] * b[1] + a[1] * b[0]);
  error[0] = dx; error[1] = dy; error[2] = dz; error[3] = rx; error[4] = ry; error[5] = rz;
  return Math.sqrt(Math.max(dx * dx + dy * dy + dz * dz, rx * rx + ry * ry + rz * rz));
}

/** step ← J⁻¹ e for six joints, (J Jᵀ)⁻¹ e for more: elimination with pivots. False where there is no such step. */
function solveStep(rows: Float64Array, n: number, { system, error, step }: RefineScratch): boolean {
  for (let i = 0; i < 6; i++) {
    for (let j = 0; j < 6; j++) {
      if (n === 6) { system[i * 7 + j] = rows[i * 6 + j]!; continue; }
      let sum = 0;
      for (let k = 0; k < n; k++) sum += rows[i * n + k]! * rows[j * n + k]!;
      system[i * 7 + j] = sum;
    }
    system[i * 7 + 6] = error[i]!;
  }
  let largest = 0;
  for (let col = 0; col < 6; col++) {
    let pivot = col;
    for (let i = col + 1; i < 6; i++) if (Math.abs(system[i * 7 + col]!) > Math.abs(system[pivot * 7 + col]!)) pivot = i;
    const size = Math.abs(system[pivot * 7 + col]!);
    largest = Math.max(largest, size);
    if (!(size > NO_PIVOT * largest)) return false;
    for (let j = col; j < 7; j++) { const swap = system[col * 7 + j]!; system[col * 7 + j] = system[pivot * 7 + j]!; system[pivot * 7 + j] = swap; }
    for (let i = col + 1; i < 6; i++) {
      const factor = system[i * 7 + col]! / system[col * 7 + col]!;
      if (factor !== 0) for (let j = col + 1; j < 7; j++) system[i * 7 + j]! -= factor * system[col * 7 + j]!;
    }
  }
  for (let i = 5; i >= 0; i--) {
    let sum = system[i * 7 + 6]!;
    for (let j = i + 1; j < 6; j++) sum -= system[i * 7 + j]! * step[j]!;
    step[i] = sum / system[i * 7 + i]!;
  }
  return true;
}
