import type { AxisTask } from "./task.ts";

/** Phases of an extreme profile: jerk up, hold, down, cruise, down, hold, up (times `sign`). */
export const PHASES = 7;
/** Jerk of each phase, in units of the limit. */
export const PHASE_JERK: Readonly<Float64Array> = Float64Array.of(1, 0, -1, 0, -1, 0, 1);

/** Accelerations beyond their bounds by this share of the limit are rounding. */
const ROUNDING = 1e-9;

/** Kept between the steps of one call: what is known of the profile (W, K, c₀, c₂) and what is found (the rest). */
const PROFILE = new Float64Array(9);
const WHOLE = 0;
const RISE = 1;
const START = 2;
const END = 3;
const HIGHEST = 4;
const LOWEST = 5;
const HOLD_1 = 6;
const HOLD_2 = 7;
const PEAK = 8;

/**
 * The farthest way an axis can come in a given time, all limits kept and the end state met.
 *
 *   accelerate, keep A, decelerate (through V, kept for a while), keep −A, let go;
 *   x the highest, y the lowest acceleration
 *   c₀ = v₀ − a₀²/2j,  c₂ = v₁ − a₁²/2j,  peak speed c₁ = c₀ + x²/j + A τ₁ = c₂ + y²/j + A τ₂,  K = j (c₂ − c₀)
 *   j T = 2 (x − y) + j (τ₁ + τ_V + τ₂) + a₁ − a₀
 *   j way = c₀ (x − a₀) + c₁ (x − y) + c₂ (a₁ − y) + (a₁³ − a₀³)/6j + j τ₁ (c₀ + c₁)/2 + j τ₂ (c₁ + c₂)/2 + j τ_V V
 *
 * For every T each case (no hold, one, both, cruise) is solved in closed form, with one square root at most. With sign
 * −1 it is the mirrored problem: the least way, given as a negative number.
 *
 * @param out  receives seven durations [s].
 * @returns    sign · way; NaN when speed and acceleration of the end cannot be met at T.
 * @see Berscheid & Kröger, Jerk-limited real-time trajectory generation with arbitrary target states, RSS 2021, for the
 * profiles.
 */
export function farthest(task: AxisTask, sign: 1 | -1, time_s: number, out: Float64Array): number {
  const j = task.jerk;
  const A = task.acceleration;
  const V = task.speed;
  const a0 = sign * task.a0;
  const a1 = sign * task.a1;
  const c0 = sign * task.v0 - (a0 * a0) / (2 * j);
  const c2 = sign * task.v1 - (a1 * a1) / (2 * j);
  let W = j * time_s + a0 - a1;
  const slack = ROUNDING * A;
  if (W < 0) {
    if (W < -slack) return Number.NaN;
    W = 0;
  }
  const X2 = j * Math.max(0, V - c0);
  const Z2 = j * Math.max(0, V - c2);
  const A2 = A * A;
  const toV = (X2 <= A2 ? 2 * Math.sqrt(X2) : A + X2 / A) + (Z2 <= A2 ? 2 * Math.sqrt(Z2) : A + Z2 / A);
  const cruise = Math.max(0, W - toV);
  if (W >= toV) {
    PROFILE[HIGHEST] = X2 <= A2 ? Math.sqrt(X2) : A;
    PROFILE[HOLD_1] = X2 <= A2 ? 0 : (X2 - A2) / A;
    PROFILE[LOWEST] = Z2 <= A2 ? -Math.sqrt(Z2) : -A;
    PROFILE[HOLD_2] = Z2 <= A2 ? 0 : (Z2 - A2) / A;
    PROFILE[PEAK] = V;
  } else {
    PROFILE[WHOLE] = W;
    PROFILE[RISE] = j * (c2 - c0);
    PROFILE[START] = c0;
    PROFILE[END] = c2;
    belowTopSpeed(task, sign);
  }
  const x = PROFILE[HIGHEST]!;
  const y = PROFILE[LOWEST]!;
  const c1 = PROFILE[PEAK]!;
  const hold1 = PROFILE[HOLD_1]!;
  const hold2 = PROFILE[HOLD_2]!;
  if (!(x >= a0 - slack && y <= a1 + slack && x >= y - slack && hold1 >= -slack && hold2 >= -slack)) return Number.NaN;
  const split = cruise > 0 || (x > 0 && y < 0) ? 0 : y;
  out[0] = (x - a0) / j;
  out[1] = hold1 / j;
  out[2] = (x - split) / j;
  out[3] = cruise / j;
  out[4] = (split - y) / j;
  out[5] = hold2 / j;
  out[6] = (a1 - y) / j;
  for (let k = 0; k < PHASES; k++) if (out[k]! < 0) out[k] = 0;
  return (
    (c0 * (x - a0) +
      c1 * (x - y) +
      c2 * (a1 - y) +
      (a1 * a1 * a1 - a0 * a0 * a0) / (6 * j) +
      (hold1 * (c0 + c1) + hold2 * (c1 + c2)) / 2 +
      cruise * V) /
    j
  );
}

/** The cases in which the top speed is not reached: no acceleration held, one or both. */
function belowTopSpeed({ jerk: j, acceleration: A, a0, a1 }: AxisTask, sign: 1 | -1): void {
  const W = PROFILE[WHOLE]!;
  const K = PROFILE[RISE]!;
  const c0 = PROFILE[START]!;
  const c2 = PROFILE[END]!;
  const h = W / 2;
  let x: number;
  let y: number;
  let hold1 = 0;
  let hold2 = 0;
  if (h > 0) {
    const k = K / h;
    x = (h + k) / 2;
    y = (k - h) / 2;
  } else {
    // No time to change the acceleration: it may stay anywhere between its two ends.
    x = Math.abs(K) <= ROUNDING * A * A ? Math.min(sign * a1, Math.max(sign * a0, 0)) : Number.NaN;
    y = x;
  }
  // The end with the lower c has the larger acceleration and meets its limit first.
  const highFirst = K >= 0 && x > A;
  const lowFirst = K < 0 && y < -A;
  if (highFirst) {
    y = A - Math.sqrt(Math.max(0, A * W - K));
    x = A;
    hold1 = W - 2 * (A - y);
  } else if (lowFirst) {
    x = Math.sqrt(Math.max(0, A * W + K)) - A;
    y = -A;
    hold2 = W - 2 * (x + A);
  }
  PROFILE[PEAK] = c0 + (x * x + A * hold1) / j;
  if ((highFirst && y < -A) || (lowFirst && x > A)) {
    x = A;
    y = -A;
    const c1 = peakOfBoth(W, c0, c2, A, j);
    hold1 = (j * (c1 - c0) - A * A) / A;
    hold2 = (j * (c1 - c2) - A * A) / A;
    PROFILE[PEAK] = c0 + (x * x + A * hold1) / j;
  }
  PROFILE[HIGHEST] = x;
  PROFILE[LOWEST] = y;
  PROFILE[HOLD_1] = hold1;
  PROFILE[HOLD_2] = hold2;
}

/** c₁ when both accelerations are held: W = 2A + j (2 c₁ − c₀ − c₂) / A. */
const peakOfBoth = (W: number, c0: number, c2: number, A: number, j: number): number =>
  ((W - 2 * A) * A) / (2 * j) + (c0 + c2) / 2;
