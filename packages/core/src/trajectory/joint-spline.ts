/** A path in joint space by one parameter. */
export interface JointPath {
  readonly joints: number;
  readonly length: number;
  /** Angles, dq/ds and d²q/ds² at s, each written from index `at` on. */
  evaluate(s: number, at: number, q: Float64Array, q1: Float64Array, q2: Float64Array): void;
}

/**
 * The cubic spline through waypoints, twice continuously differentiable, straight at both ends (natural).
 *
 *   h_{i−1} m_{i−1} + 2 (h_{i−1} + h_i) m_i + h_i m_{i+1} = 6 (Δ_i − Δ_{i−1}),   Δ_i = (q_{i+1} − q_i) / h_i,   m = q″
 *
 * The parameter grows by the distance between waypoints in joint space, or as `knots` say.
 *
 * @see de Boor, A Practical Guide to Splines, ch. 4.
 */
export class JointSpline implements JointPath {
  readonly joints: number;
  readonly length: number;
  private readonly knots: Float64Array;
  private readonly q: Float64Array;
  private readonly m: Float64Array;

  /**
   * @param waypoints  at least two, all of the same number of joints; neighbours that are the same are one.
   * @param knots      rising parameters of the waypoints, from 0.
   */
  constructor(waypoints: readonly ArrayLike<number>[], knots?: ArrayLike<number>) {
    const kept =
      knots === undefined ? waypoints.filter((point, i) => i === 0 || apart(point, waypoints[i - 1]!) > 0) : waypoints;
    const n = kept[0]?.length ?? 0;
    const count = kept.length;
    const s = new Float64Array(count);
    for (let i = 1; i < count; i++) s[i] = knots === undefined ? s[i - 1]! + apart(kept[i]!, kept[i - 1]!) : knots[i]!;
    this.joints = n;
    this.knots = s;
    this.length = count > 0 ? s[count - 1]! : 0;
    this.q = new Float64Array(count * n);
    for (let i = 0; i < count; i++) for (let j = 0; j < n; j++) this.q[i * n + j] = kept[i]![j]!;
    this.m = this.bends(count, n);
  }

  /** The tridiagonal system, eliminated once for all joints. */
  private bends(count: number, n: number): Float64Array {
    const m = new Float64Array(count * n);
    const over = new Float64Array(count);
    const { knots: s, q } = this;
    for (let i = 1; i + 1 < count; i++) {
      const before = s[i]! - s[i - 1]!;
      const after = s[i + 1]! - s[i]!;
      const pivot = 2 * (before + after) - before * over[i - 1]!;
      over[i] = after / pivot;
      for (let j = 0; j < n; j++) {
        const k = i * n + j;
        const kink = (q[k + n]! - q[k]!) / after - (q[k]! - q[k - n]!) / before;
        m[k] = (6 * kink - before * m[k - n]!) / pivot;
      }
    }
    for (let i = count - 2; i > 0; i--) for (let j = 0; j < n; j++) m[i * n + j]! -= over[i]! * m[(i + 1) * n + j]!;
    return m;
  }

  evaluate(at_s: number, at: number, out: Float64Array, out1: Float64Array, out2: Float64Array): void {
    const { knots: s, q, m, joints: n } = this;
    let low = 0;
    let high = s.length - 2;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (s[middle]! <= at_s) low = middle;
      else high = middle - 1;
    }
    const h = s[low + 1]! - s[low]!;
    const u = at_s - s[low]!;
    const v = h - u;
    for (let j = 0; j < n; j++) {
      const a = low * n + j;
      const b = a + n;
      const ma = m[a]!;
      const mb = m[b]!;
      const rise = (q[b]! - q[a]!) / h;
      out[at + j] = q[a]! + u * (rise - (h / 6) * (2 * ma + mb)) + u * u * (ma / 2 + (u * (mb - ma)) / (6 * h));
      out1[at + j] = rise - (h / 6) * (2 * ma + mb) + u * (ma + (u * (mb - ma)) / (2 * h));
      out2[at + j] = (ma * v + mb * u) / h;
    }
  }
}

function apart(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let sum = 0;
  for (let j = 0; j < a.length; j++) sum += (a[j]! - b[j]!) ** 2;
  return Math.sqrt(sum);
}
