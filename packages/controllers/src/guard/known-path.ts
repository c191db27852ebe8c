import { samplePlan, type CornerArea, type Plan } from "@twincell/core";
import { PlanFollower } from "../twin/index.ts";

/** The path that a motion takes, where it is known before: a plan, or straight from joint angles to joint angles. */
export interface KnownPath {
  /** How far any joint is from the path [rad]; NaN where that cannot be said. */
  off(q_rad: ArrayLike<number>): number;
  /** Where on the path the robot is, in the path's own measure. */
  readonly at: number;
  /**
   * As far along the path as the robot may come if it is stopped now.
   *
   * @param ahead_rad  where it would come to rest if its joints went on the way they go.
   * @param reach_s    from the word to stop to standstill, at full speed.
   */
  reach(ahead_rad: ArrayLike<number>, reach_s: number): number;
  /** The path is looked at in steps of this length. */
  readonly step: number;
  /** What the controller may make of the corners it passes without a stop, in order of `from_s`, in its measure. */
  readonly corners: readonly CornerArea[];
  sample(at: number, out: Float64Array): void;
}

/** Points of a plan that are looked at are so far from each other [s]. */
const PLAN_STEP_S = 0.005;
/** The same of a straight line between joint angles, in the joint that turns most [rad]. */
const LINE_STEP_RAD = 0.01;

/** A plan that a robot follows at whatever override. Whoever keeps it calls `take` with every sample, first of all. */
export class PlannedPath implements KnownPath {
  readonly step = PLAN_STEP_S;
  /** How far from it the robot was last [rad]; NaN before the first sample. */
  off_rad = NaN;
  readonly corners: readonly CornerArea[];
  readonly #plan: Plan;
  readonly #follower: PlanFollower;

  constructor(plan: Plan, joints: number, corners: readonly CornerArea[] = []) {
    this.#plan = plan;
    this.corners = corners;
    this.#follower = new PlanFollower(plan, joints);
  }

  get at(): number {
    return this.#follower.at_s;
  }

  take(q_rad: ArrayLike<number>): void {
    this.off_rad = this.#follower.take(q_rad);
  }

  off(): number {
    return this.off_rad;
  }

  /**
   * Never beyond the next rest: a robot that stands is stopped before it goes on, and what its gripper holds by then is
   * not known yet.
   */
  reach(_: ArrayLike<number>, reach_s: number): number {
    const end_s = Math.min(this.#plan.duration_s, this.at + reach_s);
    for (const { kind, start_s, duration_s } of this.#plan.segments) {
      if (start_s >= end_s) break;
      if (kind !== "motion" && duration_s > 0 && start_s > this.at) return start_s;
    }
    return end_s;
  }

  sample(at_s: number, out: Float64Array): void {
    samplePlan(this.#plan, at_s, out);
  }
}

/** Straight from joint angles to joint angles: 0 at the beginning, 1 at the end. */
export class StraightPath implements KnownPath {
  readonly step: number;
  readonly corners: readonly CornerArea[] = [];
  at = 0;
  readonly #from: Float64Array;
  readonly #by: Float64Array;
  readonly #length2: number;

  constructor(from_rad: ArrayLike<number>, to_rad: ArrayLike<number>) {
    this.#from = Float64Array.from(from_rad);
    this.#by = this.#from.map((from, i) => to_rad[i]! - from);
    this.#length2 = this.#by.reduce((sum, by) => sum + by * by, 0);
    const most_rad = this.#by.reduce((most, by) => Math.max(most, Math.abs(by)), 0);
    this.step = most_rad > 0 ? Math.min(1, LINE_STEP_RAD / most_rad) : 1;
  }

  off(q_rad: ArrayLike<number>): number {
    this.at = this.#along(q_rad);
    let off = 0;
    for (let i = 0; i < this.#by.length; i++)
      off = Math.max(off, Math.abs(this.#from[i]! + this.at * this.#by[i]! - q_rad[i]!));
    return off;
  }

  reach(ahead_rad: ArrayLike<number>): number {
    return Math.max(this.at, this.#along(ahead_rad));
  }

  sample(at: number, out: Float64Array): void {
    for (let i = 0; i < this.#by.length; i++) out[i] = this.#from[i]! + at * this.#by[i]!;
  }

  #along(q_rad: ArrayLike<number>): number {
    if (this.#length2 === 0) return 0;
    let sum = 0;
    for (let i = 0; i < this.#by.length; i++) sum += (q_rad[i]! - this.#from[i]!) * this.#by[i]!;
    return Math.min(1, Math.max(0, sum / this.#length2));
  }
}

/** A robot nearer to its path than this is on it, and beside it up to that: corners are rounded otherwise [rad]. */
const ON_PATH_RAD = 0.005;
const BESIDE_PATH_RAD = 0.05;
/** Points that are looked at on the way back to the path. */
const BESIDE_LOOKS = 10;

/**
 * Looks along a known path ahead of the robot, at each of its points once. How a controller rounds a corner is its own:
 * before a robot may come into the area of one, all of the area is looked at, and inside it the robot is on its path
 * wherever it is. Allocates nothing per sample.
 */
export class PathAhead {
  readonly #path: KnownPath;
  readonly #q: Float64Array;
  readonly #off: Float64Array;
  #seen = 0;
  /** Corners whose areas were looked at, as many from the first on. */
  #cornersSeen = 0;

  constructor(path: KnownPath, joints: number) {
    this.#path = path;
    this.#q = new Float64Array(joints);
    this.#off = new Float64Array(joints);
  }

  /** What was seen of it counts no longer: the cell, or what the gripper holds, is another. */
  forget(): void {
    const { at, corners } = this.#path;
    this.#seen = at;
    const ahead = corners.findIndex(({ to_s }) => to_s > at);
    this.#cornersSeen = ahead < 0 ? corners.length : ahead;
  }

  /**
   * "off": the robot is not on it. "unsafe": a point within reach of a stop is not safe.
   *
   * @param isSafe  asked with lent joint angles.
   */
  look(
    q_rad: ArrayLike<number>,
    ahead_rad: ArrayLike<number>,
    reach_s: number,
    isSafe: (q_rad: Float64Array) => boolean,
  ): "free" | "unsafe" | "off" {
    const off_rad = this.#path.off(q_rad);
    if (!(off_rad <= BESIDE_PATH_RAD) && !this.#isInCorner(q_rad)) return "off";
    const end = this.#path.reach(ahead_rad, reach_s);
    const { corners } = this.#path;
    for (; this.#cornersSeen < corners.length; this.#cornersSeen++) {
      const corner = corners[this.#cornersSeen]!;
      if (corner.from_s > end) break;
      if (!corner.postures_rad.every(isSafe)) return "unsafe";
    }
    for (let at = this.#seen; at < end; at = this.#seen) {
      const next = Math.min(end, at + this.#path.step);
      this.#path.sample(next, this.#q);
      if (!isSafe(this.#q)) return "unsafe";
      this.#seen = next;
    }
    return off_rad <= ON_PATH_RAD || this.#isFreeBeside(q_rad, end, isSafe) ? "free" : "unsafe";
  }

  /** Whether it is in the area of a corner that the path is in now. */
  #isInCorner(q_rad: ArrayLike<number>): boolean {
    const { at, corners } = this.#path;
    for (const { from_s, to_s, spacing_rad, postures_rad } of corners) {
      if (from_s > at) return false;
      if (to_s < at) continue;
      for (const posture of postures_rad) {
        let off_rad = 0;
        for (let i = 0; i < posture.length; i++) off_rad = Math.max(off_rad, Math.abs(posture[i]! - q_rad[i]!));
        if (off_rad <= spacing_rad + BESIDE_PATH_RAD) return true;
      }
    }
    return false;
  }

  /** Beside the path it is where the path is and as far off as now, less and less. */
  #isFreeBeside(q_rad: ArrayLike<number>, end: number, isSafe: (q_rad: Float64Array) => boolean): boolean {
    const { at } = this.#path;
    this.#path.sample(at, this.#off);
    for (let i = 0; i < this.#off.length; i++) this.#off[i] = q_rad[i]! - this.#off[i]!;
    for (let look = 1; look < BESIDE_LOOKS; look++) {
      const part = look / BESIDE_LOOKS;
      this.#path.sample(at + part * (end - at), this.#q);
      for (let i = 0; i < this.#off.length; i++) this.#q[i] = this.#q[i]! + (1 - part) * this.#off[i]!;
      if (!isSafe(this.#q)) return false;
    }
    return true;
  }
}
