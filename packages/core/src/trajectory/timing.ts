/** A joint path sampled for timing: rows are nodes, s rises; equal s twice marks a border where q″ may jump. */
export interface TimingGrid {
  readonly nodes: number;
  readonly joints: number;
  readonly s: Float64Array;
  /** nodes × joints: dq/ds and d²q/ds². */
  readonly q1: Float64Array;
  readonly q2: Float64Array;
  /** Largest ṡ² any rule other than the joints' allows at each node. */
  readonly cap: Float64Array;
  /** Share of the accelerations that may be used at each node; 1 when left out. */
  readonly share?: Float64Array;
  /** What the arm's weight and inertia ask of the joints; not looked at when left out. */
  readonly torque?: TorqueRows;
}

/**
 * Joint torques along a path, nodes × joints each:  low ≤ p s̈ + r ṡ² ≤ high,  with weight taken off the limits
 *
 *   p = M q′,   r = M q″ + C(q, q′) q′,   low = −τ_max − g(q),   high = τ_max − g(q)
 */
export interface TorqueRows {
  readonly p: Float64Array;
  readonly r: Float64Array;
  readonly low: Float64Array;
  readonly high: Float64Array;
}

export interface TimingLimits {
  readonly speed_rad_s: Float64Array;
  readonly acceleration_rad_s2: Float64Array;
}

/** Below this |dq/ds| [rad per unit of s] a joint does not take part in choosing s̈. */
const STILL = 1e-9;
/** More crossings than there are lines cannot be walked down. */
const MOST_TURNS = 64;

/**
 * Fastest ṡ² along a path within joint speeds, accelerations and torques, from one end speed to the other.
 *
 *   |q′ⱼ s̈ + q″ⱼ ṡ²| ≤ aⱼ,   ṡ² ≤ min ( vⱼ² / q′ⱼ², cap ),   x = ṡ²:  xᵢ₊₁ = xᵢ + 2 hᵢ s̈ᵢ
 *
 * Backwards, the largest x from which the end can still be met; forwards, the largest s̈ that stays below it. Both ends
 * of every interval are held to the accelerations. One instance per caller; allocates nothing.
 *
 * @see Pham & Pham, A new approach to time-optimal path parameterization based on reachability analysis, IEEE T-RO
 * 2018.
 */
export class PathTimer {
  private readonly limits: TimingLimits;
  /** Rules of one node; each asks low ≤ p s̈ + r ṡ² ≤ high. */
  private rows = 0;
  private p = new Float64Array(0);
  private r = new Float64Array(0);
  private low = new Float64Array(0);
  private high = new Float64Array(0);
  /** Slope over x of the line that `lower` or `upper` found to rule. */
  private slope = 0;
  constructor(limits: TimingLimits) {
    this.limits = limits;
  }

  /**
   * @param start @param end  ṡ² at both ends; 0 is standstill.
   * @param x  receives ṡ² at every node.
   * @returns  false when `start` is too fast to be slowed down in time; x[0] is then lower than asked for.
   */
  fastest(grid: TimingGrid, start: number, end: number, x: Float64Array): boolean {
    const { nodes, s } = grid;
    const last = nodes - 1;
    this.collect(grid);
    for (let i = 0; i < nodes; i++) x[i] = this.ceiling(grid, i);
    if (x[last]! > end) x[last] = end;
    for (let i = last - 1; i >= 0; i--) {
      const h = s[i + 1]! - s[i]!;
      const next = x[i + 1]!;
      if (h > 0) x[i] = this.largestStart(i, h, x[i]!, next);
      else if (x[i]! > next) x[i] = next;
      else x[i + 1] = x[i]!;
    }
    const feasible = start <= x[0]! * (1 + 1e-9) + 1e-15;
    if (x[0]! > start) x[0] = start;
    for (let i = 0; i < last; i++) {
      const h = s[i + 1]! - s[i]!;
      if (h <= 0) {
        x[i + 1] = Math.min(x[i + 1]!, x[i]!);
        continue;
      }
      const u = Math.min(this.upper(i, h, x[i]!), (x[i + 1]! - x[i]!) / (2 * h));
      x[i + 1] = Math.max(0, x[i]! + 2 * h * u);
    }
    return feasible;
  }

  /** Accelerations of the joints, then their torques where the grid has them. */
  private collect({ nodes, joints, q1, q2, share, torque }: TimingGrid): void {
    const rows = torque === undefined ? joints : 2 * joints;
    const size = nodes * rows;
    const a = this.limits.acceleration_rad_s2;
    if (this.p.length < size) {
      const more = Math.max(size, 2 * this.p.length);
      this.p = new Float64Array(more);
      this.r = new Float64Array(more);
      this.low = new Float64Array(more);
      this.high = new Float64Array(more);
    }
    this.rows = rows;
    const { p, r, low, high } = this;
    for (let i = 0, at = 0; i < nodes; i++) {
      const part = share === undefined ? 1 : share[i]!;
      for (let j = 0, from = i * joints; j < joints; j++, at++, from++) {
        p[at] = q1[from]!;
        r[at] = q2[from]!;
        high[at] = a[j]! * part;
        low[at] = -high[at]!;
      }
      if (torque === undefined) continue;
      for (let j = 0, from = i * joints; j < joints; j++, at++, from++) {
        p[at] = torque.p[from]!;
        r[at] = torque.r[from]!;
        low[at] = torque.low[from]!;
        high[at] = torque.high[from]!;
      }
    }
  }

  /** From speeds, from the grid's own cap, and from rules in which s̈ has no part. */
  private ceiling(grid: TimingGrid, i: number): number {
    const { joints, q1 } = grid;
    const v = this.limits.speed_rad_s;
    let x = grid.cap[i]!;
    for (let j = 0; j < joints; j++) {
      const p = Math.abs(q1[i * joints + j]!);
      if (p > STILL && x * p * p > v[j]! * v[j]!) x = (v[j]! * v[j]!) / (p * p);
    }
    for (let k = 0, at = i * this.rows; k < this.rows; k++, at++) {
      const p = this.p[at]!;
      const r = this.r[at]!;
      if (p > STILL || p < -STILL) continue;
      if (r > STILL && x * r > this.high[at]!) x = Math.max(0, this.high[at]! / r);
      else if (r < -STILL && x * r < this.low[at]!) x = Math.max(0, this.low[at]! / r);
    }
    return x;
  }

  /** Smallest s̈ over the interval behind node i at ṡ² = x. */
  private lower(i: number, h: number, x: number): number {
    const { p: ps, r: rs, low, high, rows } = this;
    let best = -x / (2 * h);
    this.slope = -1 / (2 * h);
    for (let at = i * rows, end = 0; end < 2; end++) {
      for (let k = 0; k < rows; k++, at++) {
        const r = rs[at]!;
        const p = end === 0 ? ps[at]! : ps[at]! + 2 * h * r;
        if (p <= STILL && p >= -STILL) continue;
        const slope = -r / p;
        const u = (p > 0 ? low[at]! : high[at]!) / p + slope * x;
        if (u > best) {
          best = u;
          this.slope = slope;
        }
      }
    }
    return best;
  }

  /** Largest s̈ over the interval behind node i at ṡ² = x. */
  private upper(i: number, h: number, x: number): number {
    const { p: ps, r: rs, low, high, rows } = this;
    let best = Number.POSITIVE_INFINITY;
    this.slope = 0;
    for (let at = i * rows, end = 0; end < 2; end++) {
      for (let k = 0; k < rows; k++, at++) {
        const r = rs[at]!;
        const p = end === 0 ? ps[at]! : ps[at]! + 2 * h * r;
        if (p <= STILL && p >= -STILL) continue;
        const slope = -r / p;
        const u = (p > 0 ? high[at]! : low[at]!) / p + slope * x;
        if (u < best) {
          best = u;
          this.slope = slope;
        }
      }
    }
    return best;
  }

  /**
   * Largest x ≤ ceiling at node i with some allowed s̈ that leads to xᵢ₊₁ ≤ next. The allowed set is convex and holds
   * (0, 0), so the crossing of the two lines in conflict is walked down until there is no conflict.
   */
  private largestStart(i: number, h: number, ceiling: number, next: number): number {
    let x = ceiling;
    for (let turn = 0; turn < MOST_TURNS; turn++) {
      const low = this.lower(i, h, x);
      const lowSlope = this.slope;
      let high = this.upper(i, h, x);
      let highSlope = this.slope;
      const landing = (next - x) / (2 * h);
      if (landing < high) {
        high = landing;
        highSlope = -1 / (2 * h);
      }
      const gap = low - high;
      const closing = lowSlope - highSlope;
      if (gap <= 1e-12 * (1 + Math.abs(low))) return x;
      const lower = closing > 0 ? x - gap / closing : 0;
      if (!(lower > 0)) return 0;
      if (!(lower < x)) return x;
      x = lower;
    }
    return x;
  }
}
