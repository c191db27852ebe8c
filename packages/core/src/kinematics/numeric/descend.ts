import type { SerialArm } from "../../model/arm.ts";
import type { Pose } from "../../spatial/pose.ts";
import { flangePose } from "../forward.ts";
import { jacobian } from "../jacobian.ts";
import type { DampedScratch } from "./damped-scratch.ts";
import { lengthAt, poseError } from "./pose-error.ts";

/** When a descent ends well, and after how many steps it ends anyway. `turnWeight_m` weighs 1 rad as so many metres. */
export interface Descent {
  readonly position_m: number;
  readonly angle_rad: number;
  readonly steps: number;
  readonly turnWeight_m: number;
}

/** Damping at the start, as a share of the largest diagonal entry of JᵀWJ. */
const FIRST_DAMPING = 1e-3;
/** No step worth taking is found beyond this share. */
const LAST_DAMPING = 1e10;
/** Rounding of a limit [rad]. */
const AT_LIMIT_RAD = 1e-12;
/** Descent per step below this share of the cost, this often in a row, is standing still. */
const WORTH_A_STEP = 1e-6;
const STEPS_IN_PLACE = 8;

/**
 * Levenberg–Marquardt on the squared error, kept inside the joint limits:
 *
 *   (JᵀWJ + μ I) Δq = JᵀW e,   W = diag(1, 1, 1, w², w², w²),   q ← clamp(q + Δq)
 *
 * μ falls with the gain ratio of each good step and doubles, ever faster, after each bad one, so that a singular
 * posture costs small steps and not large speeds. Joints at a limit that the downhill direction presses against it are
 * held and the others solve without them (active set).
 *
 * @param wanted   finite, unit quaternion.
 * @param scratch  `q` is the start, brought inside the limits, and receives the posture reached; made for n joints.
 * @returns whether position and angle are within the tolerances of `aim`. Allocates nothing.
 * @see Nielsen, Damping Parameter in Marquardt's Method, DTU 1999; Sugihara, Solvability-Unconcerned Inverse Kinematics
 * by the
 *      Levenberg–Marquardt Method, IEEE Trans. Robotics 27(5) 2011; Bertsekas, Projected Newton Methods, SIAM J.
 *      Control 20(2) 1982.
 */
export function descend(arm: SerialArm, wanted: Pose<"base", "flange">, aim: Descent, scratch: DampedScratch): boolean {
  const { q, rows, normal, uphill, step, trial, error, trialError, pressed } = scratch;
  const n = arm.joints.length;
  const w2 = aim.turnWeight_m * aim.turnWeight_m;
  clampInto(arm, q);
  let damping = 0;
  let growth = 2;
  let inPlace = 0;
  let cost = 0;
  let largest = 0;
  let fresh = true;
  for (scratch.iterations = 0; ; scratch.iterations++) {
    if (fresh) {
      jacobian(arm, q, null, rows, scratch.jacobian);
      poseError(wanted, scratch.jacobian.baseFromFlange, error);
      scratch.position_m = lengthAt(error, 0);
      scratch.angle_rad = lengthAt(error, 3);
      if (scratch.position_m < aim.position_m && (w2 === 0 || scratch.angle_rad < aim.angle_rad)) return true;
      cost = costOf(error, w2);
      largest = normalEquations(rows, error, w2, n, normal, uphill);
      findPressed(arm, q, uphill, pressed);
      if (damping === 0) damping = FIRST_DAMPING * largest;
      if (!(largest > 0) || inPlace >= STEPS_IN_PLACE) return false;
    }
    if (scratch.iterations >= aim.steps || damping > LAST_DAMPING * largest) return false;
    if (!solveHeld(normal, uphill, damping, pressed, n, scratch.factor, step)) {
      damping = Math.max(10 * damping, Number.EPSILON * largest);
      fresh = false;
      continue;
    }
    for (let j = 0; j < n; j++) trial[j] = q[j]! + step[j]!;
    clampInto(arm, trial);
    flangePose(arm, trial, scratch.flange, scratch.jacobian.arm);
    poseError(wanted, scratch.flange, trialError);
    const better = cost - costOf(trialError, w2);
    const promised = gainOf(normal, uphill, q, trial, n);
    fresh = better > 0;
    if (fresh) {
      inPlace = better < WORTH_A_STEP * cost ? inPlace + 1 : 0;
      const ratio = promised > 0 ? (2 * better) / promised - 1 : 0;
      damping *= Math.max(1 / 3, 1 - ratio * ratio * ratio);
      growth = 2;
      q.set(trial);
    } else {
      damping *= growth;
      growth *= 2;
    }
  }
}

/** pressed[j] = 1 where joint j is at a limit and the downhill direction pushes it on against that. */
function findPressed(arm: SerialArm, q: Float64Array, uphill: Float64Array, pressed: Uint8Array): void {
  for (let j = 0; j < q.length; j++) {
    const { lower_rad, upper_rad } = arm.joints[j]!.limits;
    const push = uphill[j]!;
    pressed[j] =
      (push > 0 && q[j]! >= upper_rad - AT_LIMIT_RAD) || (push < 0 && q[j]! <= lower_rad + AT_LIMIT_RAD) ? 1 : 0;
  }
}

function clampInto(arm: SerialArm, q: Float64Array): void {
  for (let j = 0; j < q.length; j++) {
    const { lower_rad, upper_rad } = arm.joints[j]!.limits;
    q[j] = Math.min(upper_rad, Math.max(lower_rad, q[j]!));
  }
}

const costOf = (e: Float64Array, w2: number): number =>
  0.5 * (e[0]! * e[0]! + e[1]! * e[1]! + e[2]! * e[2]! + w2 * (e[3]! * e[3]! + e[4]! * e[4]! + e[5]! * e[5]!));

/** normal = JᵀWJ, uphill = JᵀWe; returns the largest diagonal entry. */
function normalEquations(
  rows: Float64Array,
  error: Float64Array,
  w2: number,
  n: number,
  normal: Float64Array,
  uphill: Float64Array,
): number {
  let largest = 0;
  for (let i = 0; i < n; i++) {
    let push = 0;
    for (let row = 0; row < 6; row++) push += rows[row * n + i]! * error[row]! * (row < 3 ? 1 : w2);
    uphill[i] = push;
    for (let j = i; j < n; j++) {
      let sum = 0;
      for (let row = 0; row < 6; row++) sum += rows[row * n + i]! * rows[row * n + j]! * (row < 3 ? 1 : w2);
      normal[i * n + j] = sum;
      normal[j * n + i] = sum;
    }
    largest = Math.max(largest, normal[i * n + i]!);
  }
  return largest;
}

/** How far the linear model says the cost falls on the way really taken:  gᵀs − ½ sᵀHs. */
function gainOf(normal: Float64Array, uphill: Float64Array, from: Float64Array, to: Float64Array, n: number): number {
  let gain = 0;
  for (let i = 0; i < n; i++) {
    const s = to[i]! - from[i]!;
    let bent = 0;
    for (let j = 0; j < n; j++) bent += normal[i * n + j]! * (to[j]! - from[j]!);
    gain += s * (uphill[i]! - 0.5 * bent);
  }
  return gain;
}

/** (H + μI) s = g by Cholesky, without the held joints, whose step is 0. False where H + μI has no root. */
function solveHeld(
  H: Float64Array,
  g: Float64Array,
  damping: number,
  held: Uint8Array,
  n: number,
  L: Float64Array,
  s: Float64Array,
): boolean {
  for (let i = 0; i < n; i++) {
    for (let j = 0; j <= i; j++) {
      let sum = held[i] === 1 || held[j] === 1 ? (i === j ? 1 : 0) : H[i * n + j]! + (i === j ? damping : 0);
      for (let k = 0; k < j; k++) sum -= L[i * n + k]! * L[j * n + k]!;
      if (i !== j) L[i * n + j] = sum / L[j * n + j]!;
      else {
        if (!(sum > 0)) return false;
        L[i * n + i] = Math.sqrt(sum);
      }
    }
  }
  for (let i = 0; i < n; i++) {
    let sum = held[i] === 1 ? 0 : g[i]!;
    for (let k = 0; k < i; k++) sum -= L[i * n + k]! * s[k]!;
    s[i] = sum / L[i * n + i]!;
  }
  for (let i = n - 1; i >= 0; i--) {
    let sum = s[i]!;
    for (let k = i + 1; k < n; k++) sum -= L[k * n + i]! * s[k]!;
    s[i] = sum / L[i * n + i]!;
  }
  return true;
}
