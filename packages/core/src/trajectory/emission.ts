import type { MoveStep } from "../program/program.ts";
import type { HermitePath } from "./hermite-path.ts";
import type { MotionSegment } from "./plan.ts";
import type { RoundedLaw } from "./rounded-law.ts";

/** Halvings of an interval in time at most, so that the cubic in time meets the cubic along the path. */
const MOST_HALVINGS = 8;
/** [rad] between the cubic in time and the cubic along the path. One radian moves the TCP by about a metre. */
const TIME_TOLERANCE = 2e-7;

/**
 * Collects the nodes of one part in time: places along the path as a rounded law reaches them. Used again from run to
 * run.
 */
export class Emission {
  private readonly law: RoundedLaw;
  private readonly joints: number;
  private path: HermitePath | undefined;
  private stretch = 1;
  private nodes = 0;
  private times = new Float64Array(64);
  private q: Float64Array;
  private qd: Float64Array;
  private begun_s = 0;
  private now_s = 0;
  /** Angles and slopes at the end of an interval and in its middle, and bends nobody asks for. */
  private readonly end: Float64Array;
  private readonly endSlope: Float64Array;
  private readonly middle: Float64Array;
  private readonly middleSlope: Float64Array;
  private readonly bend: Float64Array;

  constructor(law: RoundedLaw, joints: number) {
    this.law = law;
    this.joints = joints;
    this.q = new Float64Array(64 * joints);
    this.qd = new Float64Array(64 * joints);
    this.end = new Float64Array(joints);
    this.endSlope = new Float64Array(joints);
    this.middle = new Float64Array(joints);
    this.middleSlope = new Float64Array(joints);
    this.bend = new Float64Array(joints);
  }

  /** @param stretch  everything takes that much longer than the law says. */
  start(path: HermitePath, stretch: number): void {
    this.path = path;
    this.stretch = stretch;
  }

  /** Starts a new part at s, where the path is in the interval behind `knot` and the law at its node i. */
  begin(knot: number, s: number, i: number): void {
    this.nodes = 0;
    this.begun_s = this.now_s = this.law.timeOf(i);
    this.law.at(this.now_s);
    this.evaluate(knot, s, this.end, this.endSlope);
    this.push(this.now_s, this.law.speed, this.end, this.endSlope);
  }

  /** On to the place s1 of the law's node i, halved in time until the cubic in time stays with the path. */
  interval(s1: number, i: number, knot: number): void {
    const end_s = this.law.timeOf(i);
    if (end_s <= this.now_s) return;
    this.law.at(end_s);
    this.evaluate(knot, s1, this.end, this.endSlope);
    this.fill(knot, this.now_s, end_s, s1, this.law.speed, MOST_HALVINGS);
    this.now_s = end_s;
  }

  /** Nodes up to `to_s`, the one at `from_s` being there and the state at `to_s` in `end`. */
  private fill(knot: number, from_s: number, to_s: number, s1: number, rate1: number, halvings: number): void {
    const middle_s = (from_s + to_s) / 2;
    const s = this.law.at(middle_s);
    const rate = this.law.speed;
    this.evaluate(knot, s, this.middle, this.middleSlope);
    if (halvings > 0 && this.misses(rate1, to_s - from_s)) {
      this.end.set(this.middle);
      this.endSlope.set(this.middleSlope);
      this.fill(knot, from_s, middle_s, s, rate, halvings - 1);
      this.evaluate(knot, s1, this.end, this.endSlope);
      this.fill(knot, middle_s, to_s, s1, rate1, halvings - 1);
      return;
    }
    this.push(to_s, rate1, this.end, this.endSlope);
  }

  /** Whether the cubic in time from the last node to `end` is off the path half way. */
  private misses(rate1: number, h: number): boolean {
    const n = this.joints;
    const last = (this.nodes - 1) * n;
    for (let j = 0; j < n; j++) {
      const cubic =
        (this.q[last + j]! + this.end[j]!) / 2 +
        (h * (this.qd[last + j]! * this.stretch - this.endSlope[j]! * rate1)) / 8;
      if (Math.abs(cubic - this.middle[j]!) > TIME_TOLERANCE) return true;
    }
    return false;
  }

  private evaluate(from: number, s: number, out: Float64Array, slope: Float64Array): void {
    const path = this.path;
    if (path === undefined) return;
    // An interval of the grid may reach over a node of the path. Equal places are borders of pieces, which it does not.
    const places = path.s;
    let knot = from;
    while (s > places[knot + 1]! && knot + 2 < path.nodes && places[knot + 2]! > places[knot + 1]!) knot++;
    path.evaluate(knot, s, 0, out, slope, this.bend);
  }

  private push(t_s: number, rate: number, q: Float64Array, slope: Float64Array): void {
    const n = this.joints;
    const at = this.nodes++;
    if (at >= this.times.length) {
      this.times = grown(this.times);
      this.q = grown(this.q);
      this.qd = grown(this.qd);
    }
    this.times[at] = (t_s - this.begun_s) * this.stretch;
    for (let j = 0; j < n; j++) {
      this.q[at * n + j] = q[j]!;
      this.qd[at * n + j] = (slope[j]! * rate) / this.stretch;
    }
  }

  part(step: MoveStep, start_s: number): MotionSegment {
    const count = this.nodes;
    const n = this.joints;
    const times_s = this.times.slice(0, count);
    return {
      kind: "motion",
      path: step.path,
      step: step.id,
      start_s,
      duration_s: times_s[count - 1]!,
      times_s,
      q_rad: this.q.slice(0, count * n),
      qd_rad_s: this.qd.slice(0, count * n),
    };
  }
}

function grown(from: Float64Array): Float64Array<ArrayBuffer> {
  const to = new Float64Array(2 * from.length);
  to.set(from);
  return to;
}
