import type { AxisTask } from "./task.ts";

/** Phases of an extreme profile: jerk up, hold, down, cruise, down, hold, up (times `sign`). */
export const PHASES = 7;
/** Jerk of each phase, in units of the limit. */
export const PHASE_JERK: Readonly<Float64Array> = Float64Array.of(1, 0, -1, 0, -1, 0, 1);

/** Accelerations beyond their bounds by this share of the limit are rounding. */
const ROUNDING = 1e-9;

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
  const K = j * (c2 - c0);
  let W = j * time_s + a0 - a1;
  const slack = ROUNDING * A;
  if (W < 0) {
    if (W < -slack) return Number.NaN;
    W = 0;
  }
  let x: number;
  let y: number;
  let c1: number;
  let hold1 = 0;
  let hold2 = 0;
  let cruise = 0;
  const X2 = j * Math.max(0, V - c0);
  const Z2 = j * Math.max(0, V - c2);
  const A2 = A * A;
  const toV = (X2 <= A2 ? 2 * Math.sqrt(X2) : A + X2 / A) + (Z2 <= A2 ? 2 * Math.sqrt(Z2) : A + Z2 / A);
  if (W >= toV) {
    cruise = W - toV;
    c1 = V;
    if (X2 <= A2) x = Math.sqrt(X2);
    else {
      x = A;
      hold1 = (X2 - A2) / A;
    }
    if (Z2 <= A2) y = -Math.sqrt(Z2);
    else {
      y = -A;
      hold2 = (Z2 - A2) / A;
    }
  } else {
    const h = W / 2;
    if (h > 0) {
      const k = K / h;
      x = (h + k) / 2;
      y = (k - h) / 2;
    } else x = y = Math.abs(K) <= slack * A ? Math.min(a1, Math.max(a0, 0)) : Number.NaN;
    // The end with the lower c has the larger acceleration and meets its limit first.
    if (K >= 0 && x > A) {
      y = A - Math.sqrt(Math.max(0, A * W - K));
      x = A;
      hold1 = W - 2 * (A - y);
      if (y < -A) {
        y = -A;
        c1 = peakOfBoth(W, c0, c2, A, j);
        hold1 = (j * (c1 - c0) - A2) / A;
        hold2 = (j * (c1 - c2) - A2) / A;
      }
    } else if (K < 0 && y < -A) {
      x = Math.sqrt(Math.max(0, A * W + K)) - A;
      y = -A;
      hold2 = W - 2 * (x + A);
      if (x > A) {
        x = A;
        c1 = peakOfBoth(W, c0, c2, A, j);
        hold1 = (j * (c1 - c0) - A2) / A;
        hold2 = (j * (c1 - c2) - A2) / A;
      }
    }
    c1 = c0 + (x * x + A * hold1) / j;
  }
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

/** c₁ when both accelerations are held: W = 2A + j (2 c₁ − c₀ − c₂) / A. */
const peakOfBoth = (W: number, c0: number, c2: number, A: number, j: number): number =>
  ((W - 2 * A) * A) / (2 * j) + (c0 + c2) / 2;
