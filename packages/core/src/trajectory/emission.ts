import type { MoveStep } from "../program/program.ts";
import type { HermitePath } from "./hermite-path.ts";
import type { MotionSegment } from "./plan.ts";
import type { RoundedLaw } from "./rounded-law.ts";

/** Halvings of an interval in time at most, so that the cubic in time meets the cubic along the path. */
const MOST_HALVINGS = 8;
/** [rad] between the cubic in time and the cubic along the path. One radian moves the TCP by about a metre. */
const TIME_TOLERANCE = 2e-7;

/** Collects the nodes of one part in time: places along the path as a rounded law reaches them. */
export class Emission {
  private readonly path: HermitePath;
  private readonly law: RoundedLaw;
  private readonly joints: number;
  private readonly stretch: number;
  private times: number[] = [];
  private q: number[] = [];
  private qd: number[] = [];
  private begun_s = 0;
  private now_s = 0;
  private readonly a: Float64Array;
  private readonly a1: Float64Array;
  private readonly a2: Float64Array;

  constructor(path: HermitePath, law: RoundedLaw, joints: number, stretch: number) {
    this.path = path; this.law = law; this.joints = joints; this.stretch = stretch;
    this.a = new Float64Array(joints); this.a1 = new Float64Array(joints); this.a2 = new Float64Array(joints);
  }

  /** Starts a new part at s, where the path is in the interval behind `knot` and the law at its node i. */
  begin(knot: number, s: number, i: number): void {
    this.times = []; this.q = []; this.qd = [];
    this.begun_s = this.now_s = this.law.timeOf(i);
    this.law.at(this.now_s);
    this.push(knot, s, this.now_s, this.law.speed);
  }

  /** On to the place s1 of the law's node i, halved in time until the cubic in time stays with the path. */
  interval(s1: number, i: number, knot: number): void {
    const end_s = this.law.timeOf(i);
    if (end_s <= this.now_s) return;
    this.law.at(end_s);
    this.fill(knot, this.now_s, end_s, s1, this.law.speed, MOST_HALVINGS);
    this.now_s = end_s;
  }

  /** Nodes up to `to_s`, the one at `from_s` being there. */
  private fill(knot: number, from_s: number, to_s: number, s1: number, rate1: number, halvings: number): void {
    const middle_s = (from_s + to_s) / 2, s = this.law.at(middle_s), rate = this.law.speed;
    if (halvings > 0 && this.missesAt(knot, s, s1, rate1, to_s - from_s)) {
      this.fill(knot, from_s, middle_s, s, rate, halvings - 1);
      this.fill(knot, middle_s, to_s, s1, rate1, halvings - 1);
      return;
    }
    this.push(knot, s1, to_s, rate1);
  }

  /** Whether the cubic in time from the last node to s1 is off the path half way, where the path is at s. */
  private missesAt(knot: number, s: number, s1: number, rate1: number, h: number): boolean {
    const n = this.joints, last = this.q.length - n;
    this.evaluate(knot, s1);
    for (let j = 0; j < n; j++) this.a2[j] = (this.q[last + j]! + this.a[j]!) / 2 + (h * (this.qd[last + j]! * this.stretch - this.a1[j]! * rate1)) / 8;
    const middle = this.a2.slice();
    this.evaluate(knot, s);
    for (let j = 0; j < n; j++) if (Math.abs(middle[j]! - this.a[j]!) > TIME_TOLERANCE) return true;
    return false;
  }

  private evaluate(from: number, s: number): void {
    // An interval of the grid may reach over a node of the path. Equal places are borders of pieces, which it does not.
    const places = this.path.s;
    let knot = from;
    while (s > places[knot + 1]! && knot + 2 < this.path.nodes && places[knot + 2]! > places[knot + 1]!) knot++;
    this.path.evaluate(knot, s, 0, this.a, this.a1, this.a2);
  }

  private push(knot: number, s: number, t_s: number, rate: number): void {
    this.evaluate(knot, s);
    this.times.push((t_s - this.begun_s) * this.stretch);
    for (let j = 0; j < this.joints; j++) { this.q.push(this.a[j]!); this.qd.push((this.a1[j]! * rate) / this.stretch); }
  }

  part(step: MoveStep, start_s: number): MotionSegment {
    const times_s = Float64Array.from(this.times);
    return {
      kind: "motion", path: step.path, step: step.id, start_s, duration_s: times_s[times_s.length - 1]!,
      times_s, q_rad: Float64Array.from(this.q), qd_rad_s: Float64Array.from(this.qd),
    };
  }
}
