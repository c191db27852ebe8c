import type { MoveStep } from "../program/program.ts";
import type { HermitePath } from "./hermite-path.ts";
import type { MotionSegment } from "./plan.ts";

/** Halvings of an interval in time at most, so that the cubic in time meets the cubic along the path. */
const MOST_HALVINGS = 8;
/** [rad] between the cubic in time and the cubic along the path. */
const TIME_TOLERANCE = 2e-7;

/** Collects the nodes of one part in time. */
export class Emission {
  private readonly path: HermitePath;
  private readonly joints: number;
  private readonly stretch: number;
  private times: number[] = [];
  private q: number[] = [];
  private qd: number[] = [];
  private t = 0;
  private readonly a: Float64Array;
  private readonly a1: Float64Array;
  private readonly a2: Float64Array;

  constructor(path: HermitePath, joints: number, stretch: number) {
    this.path = path; this.joints = joints; this.stretch = stretch;
    this.a = new Float64Array(joints); this.a1 = new Float64Array(joints); this.a2 = new Float64Array(joints);
  }

  /** Starts a new part at s, where the path is in the interval behind `knot` and ṡ² = x. */
  begin(knot: number, s: number, x: number): void {
    this.times = []; this.q = []; this.qd = []; this.t = 0;
    this.push(knot, s, Math.sqrt(x));
  }

  private push(knot: number, s: number, rate: number): void {
    // An interval of the grid may reach over a node of the path. Equal places are borders of pieces, which it does not.
    const places = this.path.s;
    while (s > places[knot + 1]! && knot + 2 < this.path.nodes && places[knot + 2]! > places[knot + 1]!) knot++;
    this.path.evaluate(knot, s, 0, this.a, this.a1, this.a2);
    this.times.push(this.t * this.stretch);
    for (let j = 0; j < this.joints; j++) { this.q.push(this.a[j]!); this.qd.push((this.a1[j]! * rate) / this.stretch); }
  }

  /** One interval of constant s̈, halved in time until the cubic in time stays with the path. */
  interval(s0: number, s1: number, x0: number, x1: number, dt: number, knot: number): void {
    const rate0 = Math.sqrt(x0), u = (Math.sqrt(x1) - rate0) / dt, t0 = this.t;
    const pieces = 1 << this.halvings(s0, rate0, u, dt, knot);
    for (let k = 1; k <= pieces; k++) {
      const t = (dt * k) / pieces;
      this.t = t0 + t;
      this.push(knot, k === pieces ? s1 : s0 + rate0 * t + 0.5 * u * t * t, k === pieces ? Math.sqrt(x1) : rate0 + u * t);
    }
  }

  /**
   * How often to halve. Under constant s̈ the fourth derivative by time is about 3 q″ s̈² + 6 q‴ ṡ² s̈; a cubic over h misses by
   * h⁴/384 of it. One radian moves the TCP by about a metre.
   */
  private halvings(s0: number, rate: number, u: number, dt: number, knot: number): number {
    this.path.evaluate(knot, s0, 0, this.a, this.a1, this.a2);
    let worst = 0;
    const b = this.joints * (knot + 1), a = this.joints * knot, h = this.path.s[knot + 1]! - this.path.s[knot]!, top = Math.max(rate, rate + u * dt);
    for (let j = 0; j < this.joints; j++) {
      const jerk = Math.abs(this.path.q2[b + j]! - this.path.q2[a + j]!) / h;
      worst = Math.max(worst, 3 * Math.abs(this.a2[j]!) * u * u + 6 * jerk * top * top * Math.abs(u));
    }
    let miss = (worst * dt ** 4) / 384, count = 0;
    while (miss > TIME_TOLERANCE && count < MOST_HALVINGS) { miss /= 16; count++; }
    return count;
  }

  part(step: MoveStep, start_s: number): MotionSegment {
    const times_s = Float64Array.from(this.times);
    return {
      kind: "motion", path: step.path, step: step.id, start_s, duration_s: times_s[times_s.length - 1]!,
      times_s, q_rad: Float64Array.from(this.q), qd_rad_s: Float64Array.from(this.qd),
    };
  }
}
