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
}

export interface TimingLimits { readonly speed_rad_s: Float64Array; readonly acceleration_rad_s2: Float64Array }

/** Below this |dq/ds| [rad per unit of s] a joint does not take part in choosing s̈. */
const STILL = 1e-9;
/** More crossings than there are lines cannot be walked down. */
const MOST_TURNS = 64;

/**
 * Fastest ṡ² along a path within joint speeds and accelerations, from one end speed to the other.
 *
 *   |q′ⱼ s̈ + q″ⱼ ṡ²| ≤ aⱼ,   ṡ² ≤ min ( vⱼ² / q′ⱼ², cap ),   x = ṡ²:  xᵢ₊₁ = xᵢ + 2 hᵢ s̈ᵢ
 *
 * Backwards, the largest x from which the end can still be met; forwards, the largest s̈ that stays below it. Both ends
 * of every interval are held to the accelerations. One instance per caller; allocates nothing.
 *
 * @see Pham & Pham, A new approach to time-optimal path parameterization based on reachability analysis, IEEE T-RO 2018.
 */
export class PathTimer {
  private readonly limits: TimingLimits;
  /** Slope over x of the line that `lower` or `upper` found to rule. */
  private slope = 0;
  constructor(limits: TimingLimits) { this.limits = limits; }

  /**
   * @param start @param end  ṡ² at both ends; 0 is standstill.
   * @param x  receives ṡ² at every node.
   * @returns  false when `start` is too fast to be slowed down in time; x[0] is then lower than asked for.
   */
  fastest(grid: TimingGrid, start: number, end: number, x: Float64Array): boolean {
    const { nodes, s } = grid, last = nodes - 1;
    for (let i = 0; i < nodes; i++) x[i] = this.ceiling(grid, i);
    if (x[last]! > end) x[last] = end;
    for (let i = last - 1; i >= 0; i--) {
      const h = s[i + 1]! - s[i]!, next = x[i + 1]!;
      if (h > 0) x[i] = this.largestStart(grid, i, h, x[i]!, next);
      else if (x[i]! > next) x[i] = next;
      else x[i + 1] = x[i]!;
    }
    const feasible = start <= x[0]! * (1 + 1e-9) + 1e-15;
    if (x[0]! > start) x[0] = start;
    for (let i = 0; i < last; i++) {
      const h = s[i + 1]! - s[i]!;
      if (h <= 0) { x[i + 1] = Math.min(x[i + 1]!, x[i]!); continue; }
      const u = Math.min(this.upper(grid, i, h, x[i]!), (x[i + 1]! - x[i]!) / (2 * h));
      x[i + 1] = Math.max(0, x[i]! + 2 * h * u);
    }
    return feasible;
  }

  /** From speeds, from the grid's own cap, and from accelerations of joints that only bend. */
  private ceiling(grid: TimingGrid, i: number): number {
    const { joints, q1, q2 } = grid, v = this.limits.speed_rad_s, a = this.limits.acceleration_rad_s2;
    let x = grid.cap[i]!;
    for (let j = 0; j < joints; j++) {
      const p = Math.abs(q1[i * joints + j]!), r = Math.abs(q2[i * joints + j]!);
      if (p > STILL && x * p * p > v[j]! * v[j]!) x = (v[j]! * v[j]!) / (p * p);
      if (p <= STILL && r > STILL && x * r > a[j]!) x = a[j]! / r;
    }
    return x;
  }

  /** Smallest s̈ over the interval behind node i at ṡ² = x. */
  private lower(grid: TimingGrid, i: number, h: number, x: number): number {
    const { joints, q1, q2 } = grid, a = this.limits.acceleration_rad_s2;
    let best = -x / (2 * h);
    this.slope = -1 / (2 * h);
    for (let at = i * joints, end = 0; end < 2; end++) {
      for (let j = 0; j < joints; j++, at++) {
        const r = q2[at]!, p = end === 0 ? q1[at]! : q1[at]! + 2 * h * r;
        if (p <= STILL && p >= -STILL) continue;
        const slope = -r / p, u = (p > 0 ? -a[j]! : a[j]!) / p + slope * x;
        if (u > best) { best = u; this.slope = slope; }
      }
    }
    return best;
  }

  /** Largest s̈ over the interval behind node i at ṡ² = x. */
  private upper(grid: TimingGrid, i: number, h: number, x: number): number {
    const { joints, q1, q2 } = grid, a = this.limits.acceleration_rad_s2;
    let best = Number.POSITIVE_INFINITY;
    this.slope = 0;
    for (let at = i * joints, end = 0; end < 2; end++) {
      for (let j = 0; j < joints; j++, at++) {
        const r = q2[at]!, p = end === 0 ? q1[at]! : q1[at]! + 2 * h * r;
        if (p <= STILL && p >= -STILL) continue;
        const slope = -r / p, u = (p > 0 ? a[j]! : -a[j]!) / p + slope * x;
        if (u < best) { best = u; this.slope = slope; }
      }
    }
    return best;
  }

  /**
   * Largest x ≤ ceiling at node i with some allowed s̈ that leads to xᵢ₊₁ ≤ next. The allowed set is convex and holds
   * (0, 0), so the crossing of the two lines in conflict is walked down until there is no conflict.
   */
  private largestStart(grid: TimingGrid, i: number, h: number, ceiling: number, next: number): number {
    let x = ceiling;
    for (let turn = 0; turn < MOST_TURNS; turn++) {
      const low = this.lower(grid, i, h, x), lowSlope = this.slope;
      let high = this.upper(grid, i, h, x), highSlope = this.slope;
      const landing = (next - x) / (2 * h);
      if (landing < high) { high = landing; highSlope = -1 / (2 * h); }
      const gap = low - high, closing = lowSlope - highSlope;
      if (gap <= 1e-12 * (1 + Math.abs(low))) return x;
      const lower = closing > 0 ? x - gap / closing : 0;
      if (!(lower > 0)) return 0;
      if (!(lower < x)) return x;
      x = lower;
    }
    return x;
  }
}
