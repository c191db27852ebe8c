import { brake, BRAKE_PHASES } from "./brake.ts";
import { farthest, PHASE_JERK, PHASES } from "./farthest.ts";
import { MAX_PIECES, type JerkMotion } from "./motion.ts";
import { meetingTimes, shortestScratch, shortestTime, type ShortestScratch } from "./shortest.ts";
import { axisTask, canBeReached, type AxisTask, type JerkLimits } from "./task.ts";

/** Where the axes are or shall be; missing speeds and accelerations are 0. */
export interface JerkState {
  readonly place: ArrayLike<number>;
  readonly speed?: ArrayLike<number>;
  readonly acceleration?: ArrayLike<number>;
}

/** Axis counts from 1. */
export type JerkAnswer =
  | { readonly kind: "planned" }
  /** The end asks for a speed or acceleration no motion within the limits could have come from. */
  | { readonly kind: "end-outside"; readonly axis: number }
  | { readonly kind: "not-a-number"; readonly axis: number };

const PLANNED: JerkAnswer = { kind: "planned" };

/** A way this share off what can be made at an instant is rounding. */
const ROUNDING = 1e-9;

/**
 * Plans jerk-limited motions: from any state within or outside the limits to any state that can be met, all axes
 * arriving together at the earliest instant at which each of them can. One per caller; planning allocates nothing.
 *
 * With given end speeds and accelerations, the way an axis can make in time T takes every value between the least and
 * the farthest one, and a mixture of the two motions in fixed shares,
 *
 *   u = θ u_farthest + (1 − θ) u_least,
 *
 * keeps all limits, because each of them is convex, and ends in the same speed and acceleration. So an axis that has
 * time left is given that mixture, and an axis for which T falls into a gap (it would have to come back) makes all wait
 * for the gap's end.
 */
export class JerkPlanner {
  private readonly axes: number;
  private readonly tasks: readonly AxisTask[];
  private readonly begun: readonly AxisTask[];
  private readonly scratch: ShortestScratch = shortestScratch();
  private readonly times: Float64Array;
  private readonly candidates: Float64Array;
  /** Per axis: phases of the brake, their number, and how long they take. */
  private readonly brakes: readonly Float64Array[];
  private readonly brakePhases: Uint8Array;
  private readonly brake_s: Float64Array;
  private readonly upper = new Float64Array(PHASES);
  private readonly lower = new Float64Array(PHASES);

  constructor(limits: readonly JerkLimits[]) {
    const n = limits.length;
    this.axes = n;
    this.tasks = Array.from({ length: n }, axisTask);
    this.begun = Array.from({ length: n }, axisTask);
    this.times = new Float64Array(n);
    this.candidates = new Float64Array(32 * n);
    this.brakes = Array.from({ length: n }, () => new Float64Array(2 * BRAKE_PHASES));
    this.brakePhases = new Uint8Array(n);
    this.brake_s = new Float64Array(n);
    for (let i = 0; i < n; i++) {
      const { speed, acceleration, jerk } = limits[i]!;
      for (const task of [this.tasks[i]!, this.begun[i]!]) {
        task.speed = speed;
        task.acceleration = acceleration;
        task.jerk = jerk;
      }
    }
  }

  /** @param out  receives the motion; untouched unless it is planned. */
  plan(from: JerkState, to: JerkState, out: JerkMotion): JerkAnswer {
    const n = this.axes;
    let longest = 0;
    let ruling = 0;
    let braking = false;
    for (let i = 0; i < n; i++) {
      const begun = this.begun[i]!;
      begun.v0 = from.speed ? from.speed[i]! : 0;
      begun.a0 = from.acceleration ? from.acceleration[i]! : 0;
      begun.v1 = to.speed ? to.speed[i]! : 0;
      begun.a1 = to.acceleration ? to.acceleration[i]! : 0;
      begun.way = to.place[i]! - from.place[i]!;
      if (!Number.isFinite(begun.v0 + begun.a0 + begun.v1 + begun.a1 + begun.way))
        return { kind: "not-a-number", axis: i + 1 };
      if (!canBeReached(begun.v1, begun.a1, begun.speed, begun.acceleration, begun.jerk))
        return { kind: "end-outside", axis: i + 1 };
      const time = this.braked(i) + shortestTime(this.tasks[i]!, this.scratch);
      if (this.brakePhases[i]! > 0) braking = true;
      this.times[i] = time;
      if (time > longest) {
        longest = time;
        ruling = i;
      }
    }
    if (!braking && this.inPhase(ruling, longest, from, to, out)) return PLANNED;
    const duration_s = this.earliest(longest);
    out.duration_s = duration_s;
    out.synchronised = n === 1 ? "phase" : "time";
    for (let i = 0; i < n; i++) this.layAxis(i, duration_s, from.place[i]!, to.place[i]!, out);
    return PLANNED;
  }

  /** Takes the brake of an axis off its task; returns how long it takes. */
  private braked(i: number): number {
    const begun = this.begun[i]!;
    const task = this.tasks[i]!;
    const phases = this.brakes[i]!;
    const count = brake(begun.v0, begun.a0, begun.speed, begun.acceleration, begun.jerk, phases);
    let v = begun.v0;
    let a = begun.a0;
    let way = 0;
    let total = 0;
    for (let k = 0; k < count; k++) {
      const t = phases[2 * k]!;
      const j = phases[2 * k + 1]!;
      way += t * (v + t * (a / 2 + (t * j) / 6));
      v += t * (a + (t * j) / 2);
      a += t * j;
      total += t;
    }
    task.v0 = v;
    task.a0 = a;
    task.v1 = begun.v1;
    task.a1 = begun.a1;
    task.way = begun.way - way;
    this.brakePhases[i] = count;
    this.brake_s[i] = total;
    return total;
  }

  /** The first instant from `longest` on at which every axis can arrive. */
  private earliest(longest: number): number {
    let open = true;
    for (let i = 0; i < this.axes && open; i++) open = this.canArrive(i, longest);
    if (open) return longest;
    let count = 0;
    for (let i = 0; i < this.axes; i++) {
      const found = meetingTimes(this.tasks[i]!, this.scratch);
      for (let k = 0; k < found; k++) {
        const time = this.scratch.times[k]! + this.brake_s[i]!;
        if (time > longest) this.candidates[count++] = time;
      }
    }
    const sorted = this.candidates.subarray(0, count).sort();
    for (let k = 0; k < count; k++) {
      let all = true;
      for (let i = 0; i < this.axes && all; i++) all = this.canArrive(i, sorted[k]!);
      if (all) return sorted[k]!;
    }
    // From some instant on every axis can arrive at any time: rounding alone can hide it.
    return count > 0 ? sorted[count - 1]! * (1 + ROUNDING) : longest * (1 + ROUNDING);
  }

  private canArrive(i: number, time_s: number): boolean {
    const task = this.tasks[i]!;
    const t = time_s - this.brake_s[i]!;
    if (t < 0) return false;
    if (time_s === this.times[i]) return true;
    const most = farthest(task, 1, t, this.upper);
    const least = -farthest(task, -1, t, this.lower);
    const slack = ROUNDING * (Math.abs(task.way) + task.speed * t);
    return task.way <= most + slack && task.way >= least - slack;
  }

  /** All axes along one line: the slowest axis sets the pace, and the others must keep their limits at it. */
  private inPhase(ruling: number, duration_s: number, from: JerkState, to: JerkState, out: JerkMotion): boolean {
    const lead = this.tasks[ruling]!;
    const n = this.axes;
    if (n === 1 || lead.way === 0) return false;
    for (let i = 0; i < n; i++) {
      if (i === ruling) continue;
      const task = this.tasks[i]!;
      const share = task.way / lead.way;
      const near = ROUNDING * task.speed;
      const bent = ROUNDING * task.acceleration;
      if (
        Math.abs(task.v0 - share * lead.v0) > near ||
        Math.abs(task.v1 - share * lead.v1) > near ||
        Math.abs(task.a0 - share * lead.a0) > bent ||
        Math.abs(task.a1 - share * lead.a1) > bent
      )
        return false;
    }
    this.layAxis(ruling, duration_s, from.place[ruling]!, to.place[ruling]!, out);
    const first = ruling * MAX_PIECES;
    const pieces = out.pieces[ruling]!;
    let topSpeed = Math.max(Math.abs(lead.v0), Math.abs(lead.v1));
    let topAcceleration = Math.max(Math.abs(lead.a0), Math.abs(lead.a1));
    let topJerk = 0;
    for (let k = first; k < first + pieces; k++) {
      const a = out.acceleration[k]!;
      const j = out.jerk[k]!;
      const v = out.speed[k]!;
      const end = k + 1 < first + pieces ? out.acceleration[k + 1]! : lead.a1;
      topSpeed = Math.max(topSpeed, Math.abs(v), a * end < 0 ? Math.abs(v - (a * a) / (2 * j)) : 0);
      topAcceleration = Math.max(topAcceleration, Math.abs(a));
      topJerk = Math.max(topJerk, Math.abs(j));
    }
    for (let i = 0; i < n; i++) {
      const task = this.tasks[i]!;
      const share = Math.abs(task.way / lead.way);
      if (
        i !== ruling &&
        (share * topSpeed > task.speed * (1 + 1e-12) ||
          share * topAcceleration > task.acceleration * (1 + 1e-12) ||
          share * topJerk > task.jerk * (1 + 1e-12))
      )
        return false;
    }
    out.duration_s = duration_s;
    out.synchronised = "phase";
    for (let i = 0; i < n; i++) {
      const task = this.begun[i]!;
      const share = task.way / lead.way;
      const at = i * MAX_PIECES;
      out.endPlace[i] = to.place[i]!;
      out.endSpeed[i] = task.v1;
      out.endAcceleration[i] = task.a1;
      if (i === ruling) continue;
      out.pieces[i] = pieces;
      for (let k = 0; k < pieces; k++) {
        out.begin[at + k] = out.begin[first + k]!;
        out.jerk[at + k] = share * out.jerk[first + k]!;
        out.acceleration[at + k] = share * out.acceleration[first + k]!;
        out.speed[at + k] = share * out.speed[first + k]!;
        out.place[at + k] = from.place[i]! + share * (out.place[first + k]! - from.place[ruling]!);
      }
    }
    return true;
  }

  /** Writes the pieces of one axis: its brake, then the mixture of its two extreme motions of that duration. */
  private layAxis(i: number, duration_s: number, start: number, end: number, out: JerkMotion): void {
    const task = this.tasks[i]!;
    const begun = this.begun[i]!;
    const { upper, lower } = this;
    const at = i * MAX_PIECES;
    const t = Math.max(0, duration_s - this.brake_s[i]!);
    const most = farthest(task, 1, t, upper);
    const least = -farthest(task, -1, t, lower);
    const wide = most - least;
    const slack = 1e-14 * (Math.abs(task.way) + task.speed * t);
    let share = wide > slack ? (task.way - least) / wide : 0.5;
    share = share < 1e-12 ? 0 : share > 1 - 1e-12 ? 1 : share;
    let p = start;
    let v = begun.v0;
    let a = begun.a0;
    let now = 0;
    let pieces = 0;
    const piece = (jerk: number, duration: number): void => {
      if (duration <= 0) return;
      const k = at + pieces;
      if (pieces > 0 && out.jerk[k - 1] === jerk) {
        pieces--;
        const b = at + pieces;
        const whole = now - out.begin[b]!;
        p = out.place[b]!;
        v = out.speed[b]!;
        a = out.acceleration[b]!;
        now = out.begin[b]!;
        duration += whole;
      }
      const here = at + pieces++;
      out.begin[here] = now;
      out.jerk[here] = jerk;
      out.acceleration[here] = a;
      out.speed[here] = v;
      out.place[here] = p;
      p += duration * (v + duration * (a / 2 + (duration * jerk) / 6));
      v += duration * (a + (duration * jerk) / 2);
      a += duration * jerk;
      now += duration;
    };
    for (let k = 0; k < this.brakePhases[i]!; k++) piece(this.brakes[i]![2 * k + 1]!, this.brakes[i]![2 * k]!);
    let ku = 0;
    let kl = 0;
    let leftU = share > 0 ? upper[0]! : Number.POSITIVE_INFINITY;
    let leftL = share < 1 ? lower[0]! : Number.POSITIVE_INFINITY;
    while (ku < PHASES && kl < PHASES) {
      const step = leftU < leftL ? leftU : leftL;
      if (step === Number.POSITIVE_INFINITY) break;
      piece(
        task.jerk * ((share > 0 ? share * PHASE_JERK[ku]! : 0) - (share < 1 ? (1 - share) * PHASE_JERK[kl]! : 0)),
        step,
      );
      leftU -= step;
      leftL -= step;
      if (leftU <= 0) {
        ku++;
        leftU = ku < PHASES ? upper[ku]! : 0;
      }
      if (leftL <= 0) {
        kl++;
        leftL = kl < PHASES ? lower[kl]! : 0;
      }
    }
    if (pieces === 0) {
      out.begin[at] = 0;
      out.jerk[at] = 0;
      out.acceleration[at] = a;
      out.speed[at] = v;
      out.place[at] = p;
      pieces = 1;
    }
    out.pieces[i] = pieces;
    out.endPlace[i] = end;
    out.endSpeed[i] = begun.v1;
    out.endAcceleration[i] = begun.a1;
  }
}
