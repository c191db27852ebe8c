/**
 * A place over time, s(t), whose rate has corners, with those corners rounded: the mean of s over the time window that
 * ends at t.
 *
 *   s̄(t) = (1/w) ∫ s over [t − w, t],   s̄˙(t) = (s(t) − s(t − w))/w,   s̄¨(t) = (ṡ(t) − ṡ(t − w))/w
 *
 * Where s̈ jumps by a, the rounded s⃛ is a/w. It takes w longer. Given at nodes with constant s̈ in between; before the
 * first and behind the last node s stands still. Filled again for every run; `at` allocates nothing.
 */
export class RoundedLaw {
  nodes = 0;
  window_s = 0;
  t: Float64Array = new Float64Array(64);
  private s = new Float64Array(64);
  private rate = new Float64Array(64);
  /** ∫ s dt up to each node. */
  private sum = new Float64Array(64);
  private hint = 0;
  /** Rate and its derivatives at the instant asked for last. */
  speed = 0;
  acceleration = 0;

  /** @param x  ṡ² at each place. Equal places are one. */
  fill(nodes: number, s: Float64Array, x: Float64Array, window_s: number): void {
    if (this.t.length < nodes) {
      const size = Math.max(nodes, 2 * this.t.length);
      this.t = new Float64Array(size);
      this.s = new Float64Array(size);
      this.rate = new Float64Array(size);
      this.sum = new Float64Array(size);
    }
    this.nodes = nodes;
    this.window_s = window_s;
    this.hint = 0;
    for (let i = 0; i < nodes; i++) {
      this.s[i] = s[i]!;
      this.rate[i] = Math.sqrt(x[i]!);
      if (i === 0) {
        this.t[0] = 0;
        this.sum[0] = 0;
        continue;
      }
      const h = s[i]! - s[i - 1]!;
      const r0 = this.rate[i - 1]!;
      const r1 = this.rate[i]!;
      const dt = h > 0 ? (2 * h) / (r0 + r1) : 0;
      this.t[i] = this.t[i - 1]! + dt;
      // s is a parabola over the interval: Simpson's rule is exact, and its middle lies (r0 − r1) dt / 8 above the
      // chord.
      this.sum[i] = this.sum[i - 1]! + dt * ((s[i - 1]! + s[i]!) / 2 + ((r0 - r1) * dt) / 12);
    }
  }

  get duration_s(): number {
    return this.t[this.nodes - 1]! + this.window_s;
  }

  /** Rounded place at t; `speed` and `acceleration` are then those of the same instant. */
  at(t: number): number {
    const w = this.window_s;
    if (w === 0) {
      const place = this.look(t);
      this.speed = this.lookRate;
      this.acceleration = this.lookBend;
      return place;
    }
    const late = this.look(t);
    const lateRate = this.lookRate;
    const lateSum = this.lookSum;
    const early = this.look(t - w);
    this.speed = (late - early) / w;
    this.acceleration = (lateRate - this.lookRate) / w;
    return (lateSum - this.lookSum) / w;
  }

  private lookRate = 0;
  private lookBend = 0;
  private lookSum = 0;

  /** The unrounded law: returns s, leaves rate, s̈ and ∫ s beside it. */
  private look(t: number): number {
    const last = this.nodes - 1;
    const T = this.t;
    this.lookBend = 0;
    if (t <= 0) {
      this.lookRate = 0;
      this.lookSum = this.s[0]! * t;
      return this.s[0]!;
    }
    if (t >= T[last]!) {
      this.lookRate = 0;
      this.lookSum = this.sum[last]! + this.s[last]! * (t - T[last]!);
      return this.s[last]!;
    }
    let i = this.hint;
    if (i >= last) i = last - 1;
    while (T[i]! > t) i--;
    while (T[i + 1]! <= t) i++;
    this.hint = i;
    const h = T[i + 1]! - T[i]!;
    const u = t - T[i]!;
    const r = this.rate[i]!;
    const bend = (this.rate[i + 1]! - r) / h;
    this.lookRate = r + bend * u;
    this.lookBend = bend;
    this.lookSum = this.sum[i]! + u * (this.s[i]! + u * (r / 2 + (u * bend) / 6));
    return this.s[i]! + u * (r + (u * bend) / 2);
  }

  /** When the rounded law is at the place of node i: at most one window after the law itself. */
  timeOf(i: number): number {
    const w = this.window_s;
    const low0 = this.t[i]!;
    const goal = this.s[i]!;
    if (w === 0 || i === 0) return low0;
    if (i === this.nodes - 1 || goal >= this.s[this.nodes - 1]!) return this.duration_s;
    let low = low0;
    let high = low0 + w;
    let t = low0 + w / 2;
    for (let step = 0; step < 60; step++) {
      const miss = this.at(t) - goal;
      if (miss > 0) high = t;
      else low = t;
      const next = this.speed > 0 ? t - miss / this.speed : low - 1;
      const to = next > low && next < high ? next : (low + high) / 2;
      if (Math.abs(to - t) <= 1e-12 * w + 1e-15 * t) return to;
      t = to;
    }
    return t;
  }
}
