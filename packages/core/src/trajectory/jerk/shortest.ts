import { rootsWithin } from "./roots.ts";
import type { AxisTask } from "./task.ts";

/** More instants at which a way is just met than there are. */
export const MAX_TIMES = 32;

/** Working memory of `shortestTime` and `meetingTimes`: one per caller. */
export interface ShortestScratch {
  readonly quartic: Float64Array;
  readonly roots: Float64Array;
  readonly times: Float64Array;
}
export const shortestScratch = (): ShortestScratch => ({
  quartic: new Float64Array(5),
  roots: new Float64Array(8),
  times: new Float64Array(MAX_TIMES),
});

const STEPS = 40;

/**
 * Least time in which an axis gets from state to state.
 *
 * The ways that can be made in time T reach from `−farthest(−1)` to `farthest(+1)`. Before the first instant at which
 * one of the two is the way asked for, it cannot be made. While both start from the fastest change of speed, only one
 * of them can come first: the one towards which the way lies.
 */
export function shortestTime(task: AxisTask, scratch: ShortestScratch): number {
  const up = firstTime(task, 1, scratch);
  return up >= 0 ? up : firstTime(task, -1, scratch, true);
}

/**
 * Every instant at which the way is the farthest (or least) one, not sorted. Between them it can or cannot be made
 * throughout.
 */
export function meetingTimes(task: AxisTask, scratch: ShortestScratch): number {
  const between = familyTimes(task, 1, scratch, 0);
  return familyTimes(task, -1, scratch, between);
}

/**
 * The farthest ways as a curve over time, put so that c₂ ≥ c₀ (time reversed where it is not). Parts of it, in order:
 * y > 0 with A held · y > 0 · then x > 0 > y: no hold · A held · both held · V kept.
 */
interface Family {
  j: number;
  A: number;
  V: number;
  a0: number;
  a1: number;
  c0: number;
  c2: number;
  K: number;
  S: number;
  R: number;
  /** First and last y of the part with y > 0; `high` < `low` when there is none. */
  high: number;
  low: number;
  /** Time is missing between that part and the next. */
  gap: boolean;
  /** c₁ at which x > 0 > y begins. */
  begin: number;
}

function familyOf(task: AxisTask, sign: 1 | -1): Family {
  const j = task.jerk;
  const A = task.acceleration;
  const V = task.speed;
  let a0 = sign * task.a0;
  let a1 = sign * task.a1;
  let c0 = sign * task.v0 - (a0 * a0) / (2 * j);
  let c2 = sign * task.v1 - (a1 * a1) / (2 * j);
  const R = j * sign * task.way + c0 * a0 - c2 * a1 - (a1 * a1 * a1 - a0 * a0 * a0) / (6 * j);
  if (c2 < c0) {
    let swap = c0;
    c0 = c2;
    c2 = swap;
    swap = a0;
    a0 = -a1;
    a1 = -swap;
  }
  const K = j * (c2 - c0);
  const square = a0 * a0;
  const low = a0 > 0 && K < square ? Math.sqrt(square - K) : 0;
  const begin = Math.max(a0 > 0 ? c0 + square / j : c0, a1 < 0 ? c2 + (a1 * a1) / j : c2);
  return { j, A, V, a0, a1, c0, c2, K, S: c0 + c2, R, high: K > 0 && a1 > 0 ? a1 : -1, low, gap: low > 0, begin };
}

/** Half of what UD or DU needs for a change of speed by δ, times j. */
function half(jDelta: number, A: number): number {
  if (jDelta <= 0) return 0;
  return jDelta <= A * A ? Math.sqrt(jDelta) : (A * A + jDelta) / (2 * A);
}

/** What R would be when the peak speed is c₁, less R. */
const excess = (f: Family, c1: number): number =>
  (f.c0 + c1) * half(f.j * (c1 - f.c0), f.A) + (c1 + f.c2) * half(f.j * (c1 - f.c2), f.A) - f.R;

/** T from W. */
const timeOf = (f: Family, W: number): number => (W + f.a1 - f.a0) / f.j;

/** The same where y > 0. */
function earlyExcess(f: Family, y: number): number {
  const { A, c0, c2, j } = f;
  const c1 = c2 + (y * y) / j;
  const x2 = y * y + f.K;
  const hold = x2 > A * A ? (x2 - A * A) / A : 0;
  const x = hold > 0 ? A : Math.sqrt(x2);
  return c0 * x + c1 * (x - y) - c2 * y + (hold * (c0 + c1)) / 2 - f.R;
}

/**
 * First time at which the farthest way is the one asked for. −1 when it is farther than that from the start, so that
 * the other family comes first.
 */
function firstTime(task: AxisTask, sign: 1 | -1, scratch: ShortestScratch, last = false): number {
  const f = familyOf(task, sign);
  const early = f.high >= f.low;
  if (early && f.gap) return firstOfAll(task, scratch);
  const start = early ? earlyExcess(f, f.high) : excess(f, f.begin);
  if (start > 0) {
    // Rounding alone can put the way between the two: then the fastest change of speed makes it.
    return last ? startTime(f, early) : -1;
  }
  if (early) {
    if (earlyExcess(f, f.low) >= 0 || mayHump(f)) return firstOfAll(task, scratch);
  }
  return crossing(f, early ? f.c2 : f.begin);
}

function startTime(f: Family, early: boolean): number {
  if (!early) return timeOf(f, 2 * half(f.j * (f.begin - f.c0), f.A) + 2 * half(f.j * (f.begin - f.c2), f.A));
  const x2 = f.high * f.high + f.K;
  const h = Math.min(f.A, Math.sqrt(x2)) - f.high;
  return timeOf(f, x2 > f.A * f.A ? (h * h + f.K) / f.A : 2 * h);
}

/** Whether the way may rise and fall again while y > 0; true where it is not plain. */
function mayHump(f: Family): boolean {
  if (f.high * f.high + f.K > f.A * f.A) return true;
  // d way / dh ∝ 3h² + 4jS + K²/h², convex in h² with its least value 2√3 K + 4jS.
  if (4 * f.j * f.S + 2 * Math.sqrt(3) * f.K >= 0) return false;
  const h = Math.sqrt(f.high * f.high + f.K) - f.high;
  return 3 * h * h + 4 * f.j * f.S + (f.K * f.K) / (h * h) > 0;
}

/** Where the convex part, below the way at its beginning, comes up to it. */
function crossing(f: Family, begin: number): number {
  const { j, A, V, c0, c2, K, S, R } = f;
  const atV = excess(f, V);
  if (atV <= 0 || begin >= V)
    return timeOf(f, 2 * half(j * (V - c0), A) + 2 * half(j * (V - c2), A) - Math.min(0, atV) / V);
  const firstHold = c0 + (A * A) / j;
  const bothHold = c2 + (A * A) / j;
  if (begin < firstHold) {
    const to = Math.min(firstHold, V);
    const over = to === V ? atV : excess(f, to);
    if (over >= 0) {
      // h³ + 4jS h − K²/h = 4jR,  h = x − y
      const from = half(j * (begin - c0), A) + half(j * (begin - c2), A);
      const high = half(j * (to - c0), A) + half(j * (to - c2), A);
      return timeOf(f, 2 * solveFree(from, high, excess(f, begin), over, 4 * j * S, K * K, 4 * j * R));
    }
  }
  if (begin < bothHold) {
    const to = Math.min(bothHold, V);
    const over = to === V ? atV : excess(f, to);
    if (over >= 0) {
      // h² (h − A)² + 2j c₂ h² = 2jAR + 2j c₂ A² − jS (K + A²),  h = A − y
      let h = A + Math.sqrt(j * Math.max(0, to - c2));
      const right = 2 * j * A * R + 2 * j * c2 * A * A - j * S * (K + A * A);
      const least = A + Math.sqrt(j * Math.max(0, Math.max(begin, firstHold) - c2));
      for (let step = 0; step < STEPS; step++) {
        const value = h * h * ((h - A) * (h - A) + 2 * j * c2) - right;
        const slope = 2 * h * ((h - A) * (2 * h - A) + 2 * j * c2);
        const next = slope > 0 ? Math.max(least, h - value / slope) : h;
        if (Math.abs(next - h) <= 2e-16 * h) break;
        h = next;
      }
      return timeOf(f, (h * h + K) / A);
    }
  }
  // (j/A) c₁² + A c₁ = R − S A/2 + j (c₀² + c₂²)/2A
  const right = R - (S * A) / 2 + (j * (c0 * c0 + c2 * c2)) / (2 * A);
  const c1 = (-A + Math.sqrt(Math.max(0, A * A + (4 * j * right) / A))) / ((2 * j) / A);
  return timeOf(f, 2 * A + (j * (2 * c1 - S)) / A);
}

/**
 * h with h³ + p h − k/h = r between two places at which the curve is below and above it: Newton from above, begun by a
 * chord.
 */
function solveFree(low: number, high: number, below: number, above: number, p: number, k: number, r: number): number {
  if (below === 0) return low;
  let h = low + ((high - low) * below) / (below - above);
  if (!(3 * h * h + p + k / (h * h) > 0)) h = high;
  for (let step = 0; step < STEPS; step++) {
    const q = k / h;
    const slope = 3 * h * h + p + q / h;
    const next = slope > 0 ? Math.min(high, Math.max(low, h - ((h * h + p) * h - q - r) / slope)) : high;
    if (Math.abs(next - h) <= 4e-16 * h) return next;
    h = next;
  }
  return h;
}

function firstOfAll(task: AxisTask, scratch: ShortestScratch): number {
  const count = meetingTimes(task, scratch);
  let least = Number.POSITIVE_INFINITY;
  for (let i = 0; i < count; i++) if (scratch.times[i]! < least) least = scratch.times[i]!;
  return least;
}

/** Adds the times of one family behind `at`. */
function familyTimes(task: AxisTask, sign: 1 | -1, { quartic, roots, times }: ShortestScratch, at: number): number {
  const f = familyOf(task, sign);
  const { j, A, V, c0, c2, K, S, R } = f;
  const add = (W: number): void => {
    if (at < MAX_TIMES) times[at++] = timeOf(f, W);
  };
  const free = (low: number, high: number): void => {
    quartic[4] = 1;
    quartic[3] = 0;
    quartic[2] = 4 * j * S;
    quartic[1] = -4 * j * R;
    quartic[0] = -K * K;
    const count = rootsWithin(quartic, low, high, roots, 0);
    for (let i = 0; i < count; i++) if (roots[i]! > 0) add(2 * roots[i]!);
  };
  const held = (low: number, high: number): void => {
    quartic[4] = 1;
    quartic[3] = -2 * A;
    quartic[2] = A * A + 2 * j * c2;
    quartic[1] = 0;
    quartic[0] = j * S * (K + A * A) - 2 * j * A * R - 2 * j * c2 * A * A;
    const count = rootsWithin(quartic, low, high, roots, 0);
    for (let i = 0; i < count; i++) add((roots[i]! * roots[i]! + K) / A);
  };
  if (f.high >= f.low) {
    // y falls from `high` to `low`; above `border` A is held.
    const border = Math.sqrt(Math.max(0, A * A - K));
    if (f.high >= border) held(A - f.high, A - Math.max(f.low, border));
    if (f.low <= border && K < A * A) {
      const y = Math.min(f.high, border);
      free(Math.sqrt(y * y + K) - y, Math.sqrt(f.low * f.low + K) - f.low);
    }
  }
  const begin = f.begin;
  const firstHold = c0 + (A * A) / j;
  const bothHold = c2 + (A * A) / j;
  if (begin <= V) {
    if (begin <= firstHold) {
      const to = Math.min(firstHold, V);
      free(half(j * (begin - c0), A) + half(j * (begin - c2), A), half(j * (to - c0), A) + half(j * (to - c2), A));
    }
    if (begin <= bothHold && firstHold <= V)
      held(
        A + Math.sqrt(j * Math.max(0, Math.max(begin, firstHold) - c2)),
        A + Math.sqrt(j * Math.max(0, Math.min(bothHold, V) - c2)),
      );
    if (bothHold <= V) {
      quartic[4] = 0;
      quartic[3] = 0;
      quartic[2] = j / A;
      quartic[1] = A;
      quartic[0] = (S * A) / 2 - (j * (c0 * c0 + c2 * c2)) / (2 * A) - R;
      const count = rootsWithin(quartic, Math.max(begin, bothHold), V, roots, 0);
      for (let i = 0; i < count; i++) add(2 * A + (j * (2 * roots[i]! - S)) / A);
    }
  }
  const atV = excess(f, V);
  if (atV <= 0) add(2 * half(j * (V - c0), A) + 2 * half(j * (V - c2), A) - atV / V);
  return at;
}
