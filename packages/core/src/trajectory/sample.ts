import type { MotionSegment, Plan, Segment } from "./plan.ts";

/** Index of the segment in force at t: the last that has begun. −1 for a plan without segments. */
export function segmentAt(plan: Plan, t_s: number): number {
  const segments = plan.segments;
  let low = 0;
  let high = segments.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (segments[middle]!.start_s <= t_s) low = middle;
    else high = middle - 1;
  }
  return high;
}

/**
 * Joint angles, and speeds when asked for, of one instant. Before the start it is the first posture, after the end the
 * last. Allocates nothing.
 *
 * @param outQ @param outQd  n numbers each.
 * @returns  index of the segment in force, −1 for a plan without segments (then nothing is written).
 */
export function samplePlan(plan: Plan, t_s: number, outQ: Float64Array, outQd?: Float64Array): number {
  const i = segmentAt(plan, t_s);
  if (i >= 0) sampleSegment(plan.segments[i]!, t_s - plan.segments[i]!.start_s, outQ, outQd);
  return i;
}

/** The same inside one segment, `t_s` counted from its start. */
export function sampleSegment(segment: Segment, t_s: number, outQ: Float64Array, outQd?: Float64Array): void {
  const n = outQ.length;
  if (segment.kind === "rest") {
    for (let j = 0; j < n; j++) outQ[j] = segment.q_rad[j]!;
    outQd?.fill(0);
    return;
  }
  sampleMotion(segment, knotBefore(segment.times_s, t_s), t_s, outQ, outQd);
}

/** Index i of the last interval that begins at or before t. */
function knotBefore(times: Float64Array, t: number): number {
  let low = 0;
  let high = Math.max(0, times.length - 2);
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle]! <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Index of the interval of a motion in force at t. */
export const segmentKnot = (segment: MotionSegment, t_s: number): number => knotBefore(segment.times_s, t_s);

/** Cubic Hermite curve of one interval. */
function sampleMotion(segment: MotionSegment, i: number, t_s: number, outQ: Float64Array, outQd?: Float64Array): void {
  const n = outQ.length;
  const { times_s, q_rad, qd_rad_s } = segment;
  const a = i * n;
  if (times_s.length < 2) {
    for (let j = 0; j < n; j++) outQ[j] = q_rad[j]!;
    outQd?.fill(0);
    return;
  }
  const t0 = times_s[i]!;
  const h = times_s[i + 1]! - t0;
  const u = h > 0 ? Math.min(1, Math.max(0, (t_s - t0) / h)) : 1;
  const u2 = u * u;
  const u3 = u2 * u;
  const h01 = 3 * u2 - 2 * u3;
  const h10 = (u3 - 2 * u2 + u) * h;
  const h11 = (u3 - u2) * h;
  for (let j = 0; j < n; j++) {
    const qa = q_rad[a + j]!;
    const qb = q_rad[a + n + j]!;
    outQ[j] = qa + (qb - qa) * h01 + qd_rad_s[a + j]! * h10 + qd_rad_s[a + n + j]! * h11;
  }
  if (outQd === undefined) return;
  const g01 = h > 0 ? (6 * u - 6 * u2) / h : 0;
  const g10 = 3 * u2 - 4 * u + 1;
  const g11 = 3 * u2 - 2 * u;
  for (let j = 0; j < n; j++) {
    outQd[j] = (q_rad[a + n + j]! - q_rad[a + j]!) * g01 + qd_rad_s[a + j]! * g10 + qd_rad_s[a + n + j]! * g11;
  }
}

/**
 * Accelerations of one interval at both ends: the cubic's second derivative is linear in between. @param out 2 n
 * numbers.
 */
export function intervalAccelerations(segment: MotionSegment, i: number, joints: number, out: Float64Array): void {
  const n = joints;
  const { times_s, q_rad, qd_rad_s } = segment;
  const h = times_s[i + 1]! - times_s[i]!;
  for (let j = 0; j < n; j++) {
    const a = i * n + j;
    const b = a + n;
    const rise = h > 0 ? (q_rad[b]! - q_rad[a]!) / h : 0;
    out[j] = h > 0 ? (6 * rise - 4 * qd_rad_s[a]! - 2 * qd_rad_s[b]!) / h : 0;
    out[n + j] = h > 0 ? (-6 * rise + 2 * qd_rad_s[a]! + 4 * qd_rad_s[b]!) / h : 0;
  }
}

/** Joints a plan moves; 0 for a plan without segments. */
export const jointsOf = (plan: Plan): number => {
  const first = plan.segments[0];
  return first === undefined
    ? 0
    : first.kind === "rest"
      ? first.q_rad.length
      : first.q_rad.length / first.times_s.length;
};

/** What holds at an instant of a plan, beside the joint angles. */
export interface PlanMoment {
  segment: number;
  step: string;
  gripperClosed: boolean;
  moving: boolean;
}

/**
 * Plays a plan: remembers where it was, so that going forward costs no search. Jumping back is fine and costs one.
 * One per player; allocates only when made.
 */
export class PlanCursor {
  readonly plan: Plan;
  readonly moment: PlanMoment = { segment: -1, step: "", gripperClosed: false, moving: false };
  /** State of the gripper in each segment. */
  private readonly closed: Uint8Array;
  private segment = 0;
  private knot = 0;

  constructor(plan: Plan, gripperClosed = false) {
    this.plan = plan;
    this.closed = new Uint8Array(plan.segments.length);
    let state = gripperClosed;
    for (let i = 0; i < plan.segments.length; i++) {
      const segment = plan.segments[i]!;
      if (segment.kind === "rest") state = segment.gripperClosed;
      this.closed[i] = state ? 1 : 0;
    }
  }

  /** Joint angles at t; the moment is lent until the next call. */
  at(t_s: number, outQ: Float64Array, outQd?: Float64Array): PlanMoment {
    const segments = this.plan.segments;
    const moment = this.moment;
    if (segments.length === 0) return moment;
    if (t_s < segments[this.segment]!.start_s) {
      this.segment = segmentAt(this.plan, t_s);
      this.knot = 0;
    }
    while (this.segment + 1 < segments.length && segments[this.segment + 1]!.start_s <= t_s) {
      this.segment++;
      this.knot = 0;
    }
    const segment = segments[this.segment]!;
    const local = t_s - segment.start_s;
    if (segment.kind === "rest") sampleSegment(segment, local, outQ, outQd);
    else {
      const times = segment.times_s;
      if (this.knot + 1 >= times.length || times[this.knot]! > local) this.knot = knotBefore(times, local);
      while (this.knot + 2 < times.length && times[this.knot + 1]! <= local) this.knot++;
      sampleMotion(segment, this.knot, local, outQ, outQd);
    }
    moment.segment = this.segment;
    moment.step = segment.step;
    moment.gripperClosed = this.closed[this.segment] === 1;
    moment.moving = segment.kind === "motion" && t_s < this.plan.duration_s;
    return moment;
  }
}

/** The outputs of a plan at an instant. One per player; going back costs a start from the beginning. */
export class PlanSignals {
  /** Lent: changes with every call of `at`. */
  readonly values: Map<string, boolean | number> = new Map();
  private readonly plan: Plan;
  private next = 0;
  private last_s = Number.NEGATIVE_INFINITY;
  constructor(plan: Plan) {
    this.plan = plan;
  }

  at(t_s: number): ReadonlyMap<string, boolean | number> {
    if (t_s < this.last_s) {
      this.next = 0;
      this.values.clear();
    }
    this.last_s = t_s;
    for (
      let write = this.plan.writes[this.next];
      write !== undefined && write.at_s <= t_s;
      write = this.plan.writes[++this.next]
    )
      this.values.set(write.signal, write.to);
    return this.values;
  }
}
