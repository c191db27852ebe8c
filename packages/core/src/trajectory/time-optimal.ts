import type { JointPath } from "./joint-spline.ts";
import { PathTimer, type TimingLimits, type TorqueRows } from "./timing.ts";

/**
 * Inverse dynamics of an arm that has masses: the torques [N m] that give the joints an acceleration.
 *
 * @param out  receives n torques.
 */
export type JointTorques = (q: Float64Array, qd: Float64Array, qdd: Float64Array, out: Float64Array) => void;

export interface TimeOptimalOptions {
  /** Places along the path at which the limits are held. */
  readonly places?: number;
  /** The arm's weight and inertia, and what its joints can give [N m]. */
  readonly dynamics?: { readonly torques: JointTorques; readonly limit_Nm: ArrayLike<number> };
  /** Speeds along the path at both ends; standstill by default. */
  readonly startRate?: number;
  readonly endRate?: number;
}

/** When a path is where: places along it, the rate there, and the time. */
export interface PathTiming {
  readonly s: Float64Array;
  readonly rate: Float64Array;
  readonly times_s: Float64Array;
  readonly duration_s: number;
}

export type TimeOptimal =
  | { readonly kind: "timed"; readonly timing: PathTiming }
  /** The weight alone asks more of a joint than it can give; joint counts from 1. */
  | {
      readonly kind: "too-heavy";
      readonly joint: number;
      readonly s: number;
      readonly weight_Nm: number;
      readonly limit_Nm: number;
    }
  /** The rate at the start is too high for the path. */
  | { readonly kind: "start-too-fast"; readonly most: number };

/**
 * The fastest way along a joint path within joint speeds, accelerations and torques.
 *
 * Limits hold at every place; between two places s̈ is constant. The torques are taken apart into what goes with s̈ and
 * with ṡ² by three calls of the dynamics at each place:
 *
 *   g = τ(q, 0, 0),   M q′ = τ(q, 0, q′) − g,   M q″ + C q′ = τ(q, q′, q″) − g
 */
export function timeOptimal(path: JointPath, limits: TimingLimits, options: TimeOptimalOptions = {}): TimeOptimal {
  const { places = 1001, dynamics, startRate = 0, endRate = 0 } = options;
  const n = path.joints;
  const s = new Float64Array(places);
  const q = new Float64Array(places * n);
  const q1 = q.slice();
  const q2 = q.slice();
  const x = new Float64Array(places);
  for (let i = 0; i < places; i++) {
    s[i] = i + 1 === places ? path.length : (path.length * i) / (places - 1);
    path.evaluate(s[i]!, i * n, q, q1, q2);
  }
  const rows =
    dynamics === undefined ? undefined : torqueRows(dynamics.torques, dynamics.limit_Nm, places, n, q, q1, q2);
  if (rows !== undefined) {
    for (let k = 0; k < places * n; k++) {
      if (rows.low[k]! <= 0 && rows.high[k]! >= 0) continue;
      const limit_Nm = (rows.high[k]! - rows.low[k]!) / 2;
      const weight_Nm = -(rows.high[k]! + rows.low[k]!) / 2;
      return { kind: "too-heavy", joint: (k % n) + 1, s: s[Math.floor(k / n)]!, weight_Nm, limit_Nm };
    }
  }
  const cap = new Float64Array(places).fill(Number.POSITIVE_INFINITY);
  const fits = new PathTimer(limits).fastest(
    { nodes: places, joints: n, s, q1, q2, cap, ...(rows === undefined ? {} : { torque: rows }) },
    startRate * startRate,
    endRate * endRate,
    x,
  );
  if (!fits) return { kind: "start-too-fast", most: Math.sqrt(x[0]!) };
  const rate = new Float64Array(places);
  const times_s = new Float64Array(places);
  for (let i = 0; i < places; i++) {
    rate[i] = Math.sqrt(x[i]!);
    const h = i > 0 ? s[i]! - s[i - 1]! : 0;
    if (i > 0) times_s[i] = times_s[i - 1]! + (h > 0 ? (2 * h) / (rate[i - 1]! + rate[i]!) : 0);
  }
  return { kind: "timed", timing: { s, rate, times_s, duration_s: times_s[places - 1]! } };
}

function torqueRows(
  torques: JointTorques,
  limit_Nm: ArrayLike<number>,
  places: number,
  n: number,
  q: Float64Array,
  q1: Float64Array,
  q2: Float64Array,
): TorqueRows {
  const p = new Float64Array(places * n);
  const r = p.slice();
  const low = p.slice();
  const high = p.slice();
  const still = new Float64Array(n);
  const weight = new Float64Array(n);
  const out = new Float64Array(n);
  for (let i = 0; i < places; i++) {
    const from = i * n;
    const here = q.subarray(from, from + n);
    const slope = q1.subarray(from, from + n);
    const bend = q2.subarray(from, from + n);
    torques(here, still, still, weight);
    torques(here, still, slope, out);
    for (let j = 0; j < n; j++) p[from + j] = out[j]! - weight[j]!;
    torques(here, slope, bend, out);
    for (let j = 0; j < n; j++) {
      r[from + j] = out[j]! - weight[j]!;
      low[from + j] = -limit_Nm[j]! - weight[j]!;
      high[from + j] = limit_Nm[j]! - weight[j]!;
    }
  }
  return { p, r, low, high };
}
