import type { Robot } from "../model/robot.ts";
import type { MoveStep, Speed } from "../program/program.ts";
import { Emission } from "./emission.ts";
import type { HermitePath, Piece } from "./hermite-path.ts";
import type { MotionSegment } from "./plan.ts";
import { Rounder } from "./rounder.ts";
import { intervalAccelerations } from "./sample.ts";
import { PathTimer, type TimingGrid, type TimingLimits } from "./timing.ts";

/**
 * Share of the published limits the planner uses. The rest covers what lies between two nodes, so that the limits hold
 * at every instant.
 */
const SPEED_SHARE = 0.999;
const ACCELERATION_SHARE = 0.98;
/** Intervals of the timing grid on a piece, and on one that begins or ends at rest. */
const INTERVALS = 4;
const INTERVALS_AT_REST = 12;
/** How often the grid is made denser when the cubics between its nodes are over a limit. */
const MOST_DENSE = 4;
/** Least ṡ² inside a run. */
const SLOWEST = 1e-10;
/** Nodes closer than this share of a piece are one. */
const NEAR = 1e-6;
/** A run is tried with less acceleration when this share of it or less would do. */
const WORTHWHILE = 0.9;
/**
 * A run over its limits by more than this factor of time is eased where it is, not as a whole; so often; and a little
 * more each time than was missing.
 */
const WORTH_EASING = 1.003;
const EASING_ROUNDS = 8;
const EASING_MORE = 1.01;
/** Rounds in which the pace of moves of a given duration is tuned inside a run. */
const ROUNDS = 12;

/** A move whose commanded speed some joint cannot follow: the joint that falls short most, and by how much. */
export interface Slowed {
  /** Move of the run, from 0. */
  readonly move: number;
  /** Counts from 1. */
  readonly joint: number;
  readonly wanted: number;
  readonly limit: number;
  readonly unit: "rad/s" | "rad/s2" | "rad/s3";
  /** Place along the path of the run. */
  readonly s: number;
}

/** A run laid out in time: for each move its part, `start_s` counted from the start of the run. */
export interface TimedRun {
  readonly parts: readonly MotionSegment[];
  readonly slowed: readonly Slowed[];
  readonly duration_s: number;
}

/** Joint limits of a robot as the planner uses them. */
export const planningLimits = (robot: Robot): TimingLimits => ({
  speed_rad_s: Float64Array.from(robot.arm.joints, joint => joint.limits.speed_rad_s * SPEED_SHARE),
  acceleration_rad_s2: Float64Array.from(
    robot.arm.joints,
    joint => joint.limits.acceleration_rad_s2 * ACCELERATION_SHARE,
  ),
});

/** What a step's speed means along the path: a share of joint speed and a speed of the TCP. */
export interface Pace {
  readonly ratio: number;
  readonly mps: number;
  readonly time_s: number;
}

export function paceOf(speed: Speed, path: MoveStep["path"], robot: Robot): Pace {
  if ("mps" in speed) return { ratio: 1, mps: speed.mps, time_s: 0 };
  if ("time_s" in speed) return { ratio: 1, mps: Number.POSITIVE_INFINITY, time_s: speed.time_s };
  return {
    ratio: speed.ratio,
    mps: path === "ptp" ? Number.POSITIVE_INFINITY : speed.ratio * robot.maxTcpSpeed_mps,
    time_s: 0,
  };
}

/** Gives a run's path its times. One per planner; its arrays are reused. */
export class RunTimer {
  private readonly robot: Robot;
  private readonly limits: TimingLimits;
  private readonly timer: PathTimer;
  private readonly joints: number;
  private readonly rounder: Rounder;
  private readonly emission: Emission;
  private nodes = 0;
  private s = new Float64Array(64);
  private cap = new Float64Array(64);
  private x = new Float64Array(64);
  private share = new Float64Array(64);
  private eased = new Float64Array(64).fill(1);
  private owner = new Int32Array(64);
  private knot = new Int32Array(64);
  private q: Float64Array;
  private q1: Float64Array;
  private q2: Float64Array;
  private readonly bend: Float64Array;

  constructor(robot: Robot) {
    this.robot = robot;
    this.joints = robot.arm.joints.length;
    this.limits = planningLimits(robot);
    this.timer = new PathTimer(this.limits);
    this.rounder = new Rounder(robot);
    this.emission = new Emission(this.rounder.law, this.joints);
    this.bend = new Float64Array(2 * this.joints);
    this.q = new Float64Array(64 * this.joints);
    this.q1 = this.q.slice();
    this.q2 = this.q.slice();
  }

  /** @param tcpSlope  |dp/ds| of the TCP of a move at a posture, for joint legs that have a speed in m/s. */
  time(
    path: HermitePath,
    steps: readonly MoveStep[],
    q0: Float64Array,
    tcpSlope: (move: number, q: Float64Array, q1: Float64Array) => number,
  ): TimedRun {
    const paces = steps.map(step => paceOf(step.speed, step.path, this.robot));
    const slowed: Slowed[] = [];
    if (path.nodes < 2) return { parts: steps.map(step => this.standing(step, q0)), slowed, duration_s: 0 };
    let run: TimedRun | undefined;
    let over = 1;
    for (let density = 1; density <= MOST_DENSE; density *= 2) {
      slowed.length = 0;
      this.spread(path, density);
      this.capSpeeds(path, paces, tcpSlope, slowed);
      const grid: TimingGrid = {
        nodes: this.nodes,
        joints: this.joints,
        s: this.s,
        q1: this.q1,
        q2: this.q2,
        cap: this.cap,
        share: this.share,
      };
      const softness = this.soften(grid, steps);
      let stretch = 1;
      if (steps.length === 1 && paces[0]!.time_s > 0) stretch = this.stretchOf(paces[0]!.time_s, slowed);
      else if (paces.some(pace => pace.time_s > 0)) this.tune(grid, paces, softness, slowed);
      run = this.emit(path, steps, stretch, slowed);
      // The grid holds the limits at its nodes; what rounding and the cubics do between them is looked at here.
      over = this.worstShare(run.parts);
      for (let round = 0; over > WORTH_EASING && stretch === 1 && round < EASING_ROUNDS; round++) {
        this.ease(run.parts);
        this.solve(grid);
        this.rounder.round(grid, this.x, softness);
        run = this.emit(path, steps, stretch, slowed);
        over = this.worstShare(run.parts);
      }
      if (over <= 1) return run;
    }
    return this.emit(path, steps, over, slowed);
  }

  private solve(grid: TimingGrid): void {
    this.timer.fastest(grid, 0, 0, this.x);
    // A node inside the run that rounding left at standstill would never be passed.
    for (let i = 1; i + 1 < this.nodes; i++) if (this.x[i]! < SLOWEST) this.x[i] = SLOWEST;
  }

  /**
   * Fastest run with its corners rounded. A slow run reaches its speed long before the corner is round: less
   * acceleration with a corner rounded over as much less time has the same jerk, and the ramp as a whole is shortest
   * when both take equally long.
   *
   * @returns  share of the accelerations that is used, 0 … 1.
   */
  private soften(grid: TimingGrid, steps: readonly MoveStep[]): number {
    this.fillShare(steps, 1);
    this.solve(grid);
    this.rounder.round(grid, this.x, 1);
    const softness = this.rounder.softness(grid, this.x);
    if (softness > WORTHWHILE) return 1;
    const hard_s = this.rounder.law.duration_s;
    this.fillShare(steps, softness);
    this.solve(grid);
    this.rounder.round(grid, this.x, softness);
    if (this.rounder.law.duration_s < hard_s) return softness;
    this.fillShare(steps, 1);
    this.solve(grid);
    this.rounder.round(grid, this.x, 1);
    return 1;
  }

  private fillShare(steps: readonly MoveStep[], softness: number): void {
    for (let i = 0; i < this.nodes; i++) this.share[i] = softness * (steps[this.owner[i]!]!.acceleration?.ratio ?? 1);
  }

  /**
   * How far, as a factor of time, the cubics of the parts are over the published limits; at most 1 when they are not.
   */
  private worstShare(parts: readonly MotionSegment[]): number {
    let worst = 0;
    for (const part of parts)
      for (let i = 0; i + 1 < part.times_s.length; i++) worst = Math.max(worst, this.shareIn(part, i));
    return worst;
  }

  /** The same for one interval of one part. */
  private shareIn(part: MotionSegment, i: number): number {
    const joints = this.robot.arm.joints;
    const n = this.joints;
    const bend = this.bend;
    intervalAccelerations(part, i, n, bend);
    const h = part.times_s[i + 1]! - part.times_s[i]!;
    let worst = 0;
    for (let j = 0; j < n; j++) {
      const { speed_rad_s, acceleration_rad_s2 } = joints[j]!.limits;
      const at = i * n + j;
      const middle =
        h > 0
          ? (1.5 * (part.q_rad[at + n]! - part.q_rad[at]!)) / h - (part.qd_rad_s[at]! + part.qd_rad_s[at + n]!) / 4
          : 0;
      const acceleration = Math.max(Math.abs(bend[j]!), Math.abs(bend[n + j]!));
      worst = Math.max(
        worst,
        Math.sqrt(acceleration / acceleration_rad_s2),
        Math.abs(middle) / speed_rad_s,
        Math.abs(part.qd_rad_s[at]!) / speed_rad_s,
      );
    }
    return worst;
  }

  /**
   * Lowers the pace where the parts are over a limit, and as long around it as corners are rounded over: rounding lets
   * a bend of the path be entered faster than its place allows. The rest of the run keeps its pace.
   */
  private ease(parts: readonly MotionSegment[]): void {
    const { law } = this.rounder;
    const around_s = law.window_s;
    let node = 0;
    for (const part of parts) {
      for (let i = 0; i + 1 < part.times_s.length; i++) {
        const share = this.shareIn(part, i);
        if (share <= 1) continue;
        const from_s = part.start_s + part.times_s[i]! - around_s;
        const to_s = part.start_s + part.times_s[i + 1]!;
        while (node > 0 && law.t[node]! > from_s) node--;
        while (node < this.nodes && law.t[node]! < from_s) node++;
        for (let k = Math.max(0, node - 1); k < this.nodes && law.t[k]! <= to_s; k++)
          this.eased[k] = Math.max(this.eased[k]!, share);
      }
    }
    for (let i = 0; i < this.nodes; i++) {
      if (this.eased[i]! > 1) this.cap[i] = Math.min(this.cap[i]!, this.x[i]! / (this.eased[i]! * EASING_MORE) ** 2);
      this.eased[i] = 1;
    }
  }

  private standing(step: MoveStep, q0: Float64Array): MotionSegment {
    const n = this.joints;
    return {
      kind: "motion",
      path: step.path,
      step: step.id,
      start_s: 0,
      duration_s: 0,
      times_s: new Float64Array(1),
      q_rad: q0.slice(),
      qd_rad_s: new Float64Array(n),
    };
  }

  /** Fills the grid: nodes closer together where the run stands still, one at every change of move. */
  private spread(path: HermitePath, density: number): void {
    this.nodes = 0;
    const last = path.pieces.length - 1;
    for (let k = 0; k <= last; k++) {
      const piece = path.pieces[k]!;
      const a = path.s[piece.first]!;
      const b = path.s[piece.last]!;
      const rests = (k === 0 ? 1 : 0) + (k === last ? 2 : 0);
      const dense = piece.last - piece.first;
      const count = density * (rests === 0 ? Math.max(INTERVALS, dense) : Math.max(INTERVALS_AT_REST, 2 * dense));
      let i = piece.first;
      let split = piece.before !== piece.after;
      const near = (b - a) * NEAR;
      for (let m = 0; m <= count; m++) {
        let s = m === count ? b : a + (b - a) * graded(m / count, rests);
        if (split && s >= piece.split - near) {
          split = false;
          if (s > piece.split + near) {
            while (i + 1 < piece.last && path.s[i + 1]! <= piece.split) i++;
            this.node(path, i, piece.split, piece);
          } else s = piece.split;
        }
        while (i + 1 < piece.last && path.s[i + 1]! <= s) i++;
        this.node(path, i, s, piece);
      }
    }
  }

  private node(path: HermitePath, i: number, s: number, piece: Piece): void {
    if (this.nodes >= this.s.length) this.grow();
    const at = this.nodes++;
    this.s[at] = s;
    this.knot[at] = i;
    this.owner[at] = s < piece.split ? piece.before : piece.after;
    path.evaluate(i, s, at * this.joints, this.q, this.q1, this.q2);
  }

  private grow(): void {
    const more = this.s.length * 2;
    const n = this.joints;
    const to = (from: Float64Array, size: number): Float64Array<ArrayBuffer> => {
      const big = new Float64Array(size);
      big.set(from);
      return big;
    };
    const ints = (from: Int32Array): Int32Array<ArrayBuffer> => {
      const big = new Int32Array(more);
      big.set(from);
      return big;
    };
    this.s = to(this.s, more);
    this.cap = to(this.cap, more);
    this.x = to(this.x, more);
    this.share = to(this.share, more);
    this.eased = new Float64Array(more).fill(1);
    this.q = to(this.q, more * n);
    this.q1 = to(this.q1, more * n);
    this.q2 = to(this.q2, more * n);
    this.owner = ints(this.owner);
    this.knot = ints(this.knot);
  }

  /** ṡ² that the commanded speeds allow, and which joints could not follow them. */
  private capSpeeds(
    path: HermitePath,
    paces: readonly Pace[],
    tcpSlope: (move: number, q: Float64Array, q1: Float64Array) => number,
    slowed: Slowed[],
  ): void {
    const n = this.joints;
    const v = this.limits.speed_rad_s;
    const worst = new Map<number, Slowed>();
    for (let i = 0; i < this.nodes; i++) {
      const move = this.owner[i]!;
      const pace = paces[move]!;
      const at = i * n;
      let cap = Number.POSITIVE_INFINITY;
      if (pace.mps < Number.POSITIVE_INFINITY) {
        const k = this.knot[i]!;
        let slope = Math.max(path.tcp[k]!, path.tcp[k + 1]!);
        if (slope === 0) slope = tcpSlope(move, this.q.subarray(at, at + n), this.q1.subarray(at, at + n));
        else slope = Math.max(1, slope);
        cap = (pace.mps / Math.max(slope, 1e-9)) ** 2;
      }
      if (pace.ratio < 1) {
        for (let j = 0; j < n; j++) {
          const p = Math.abs(this.q1[at + j]!);
          if (p > 0) cap = Math.min(cap, ((v[j]! * pace.ratio) / p) ** 2);
        }
      } else if (cap < Number.POSITIVE_INFINITY) {
        const rate = Math.sqrt(cap);
        for (let j = 0; j < n; j++) {
          const wanted = Math.abs(this.q1[at + j]!) * rate;
          const by = wanted / v[j]!;
          const limit = this.robot.arm.joints[j]!.limits.speed_rad_s;
          const found = worst.get(move);
          if (by > 1 && (found === undefined || wanted / limit > found.wanted / found.limit)) {
            worst.set(move, { move, joint: j + 1, wanted, limit, unit: "rad/s", s: this.s[i]! });
          }
        }
      }
      this.cap[i] = cap;
    }
    slowed.push(...worst.values());
  }

  private intervalTime_s(i: number): number {
    const h = this.s[i + 1]! - this.s[i]!;
    return h > 0 ? (2 * h) / (Math.sqrt(this.x[i]!) + Math.sqrt(this.x[i + 1]!)) : 0;
  }

  /** Seconds each move takes. */
  private moveTimes_s(moves: number): Float64Array {
    const times = new Float64Array(moves);
    for (let i = 0; i + 1 < this.nodes; i++) times[this.owner[i]!]! += this.intervalTime_s(i);
    // Half of the window is spent before the run has its pace, half behind it.
    times[this.owner[0]!]! += this.rounder.law.window_s / 2;
    times[this.owner[this.nodes - 1]!]! += this.rounder.law.window_s / 2;
    return times;
  }

  /** A lone move of given duration keeps its shape and takes longer. */
  private stretchOf(time_s: number, slowed: Slowed[]): number {
    const least_s = this.moveTimes_s(1)[0]!;
    if (least_s <= time_s * (1 + 1e-9)) return time_s / least_s;
    slowed.push(this.tooShort(0, least_s / time_s));
    return 1;
  }

  /** The joint that a duration shorter by `factor` asks too much of. */
  private tooShort(move: number, factor: number): Slowed {
    const n = this.joints;
    let found: Slowed = { move, joint: 1, wanted: 0, limit: 1, unit: "rad/s2", s: 0 };
    let by = 0;
    for (let i = 0; i + 1 < this.nodes; i++) {
      if (this.owner[i] !== move) continue;
      const rate = Math.sqrt(this.x[i]!);
      const h = this.s[i + 1]! - this.s[i]!;
      const u = h > 0 ? (this.x[i + 1]! - this.x[i]!) / (2 * h) : 0;
      for (let j = 0; j < n; j++) {
        const limit = this.robot.arm.joints[j]!.limits;
        const at = i * n + j;
        const speed = Math.abs(this.q1[at]!) * rate * factor;
        const bend = Math.abs(this.q1[at]! * u + this.q2[at]! * this.x[i]!) * factor * factor;
        // A speed over its limit is the plainer reason; acceleration only speaks when no speed does.
        if (speed / limit.speed_rad_s > Math.max(1, found.unit === "rad/s" ? by : 0)) {
          by = speed / limit.speed_rad_s;
          found = { move, joint: j + 1, wanted: speed, limit: limit.speed_rad_s, unit: "rad/s", s: this.s[i]! };
        } else if (found.unit === "rad/s2" && bend / limit.acceleration_rad_s2 > by) {
          by = bend / limit.acceleration_rad_s2;
          found = { move, joint: j + 1, wanted: bend, limit: limit.acceleration_rad_s2, unit: "rad/s2", s: this.s[i]! };
        }
      }
    }
    if (found.wanted > found.limit) return found;
    const { joint, load, limit } = this.rounder.worst;
    return { move, joint, wanted: load * limit * factor ** 3, limit, unit: "rad/s3", s: 0 };
  }

  /** Moves of given duration inside a run: their pace is lowered until each takes its time. */
  private tune(grid: TimingGrid, paces: readonly Pace[], softness: number, slowed: Slowed[]): void {
    const first = this.moveTimes_s(paces.length);
    const lengths = new Float64Array(paces.length);
    const pace = new Float64Array(paces.length);
    for (let i = 0; i + 1 < this.nodes; i++) lengths[this.owner[i]!]! += this.s[i + 1]! - this.s[i]!;
    for (let m = 0; m < paces.length; m++) {
      const time_s = paces[m]!.time_s;
      if (time_s <= 0) continue;
      pace[m] = lengths[m]! / time_s;
      if (first[m]! > time_s * (1 + 1e-6)) slowed.push(this.tooShort(m, first[m]! / time_s));
    }
    for (let round = 0; round < ROUNDS; round++) {
      for (let i = 0; i < this.nodes; i++) {
        const p = pace[this.owner[i]!]!;
        if (p > 0) this.cap[i] = p * p;
      }
      this.solve(grid);
      this.rounder.round(grid, this.x, softness);
      const times = this.moveTimes_s(paces.length);
      let off = 0;
      for (let m = 0; m < paces.length; m++) {
        if (pace[m]! <= 0) continue;
        const factor = times[m]! / paces[m]!.time_s;
        off = Math.max(off, Math.abs(factor - 1));
        pace[m]! *= Math.min(4, factor);
      }
      if (off < 1e-4) return;
    }
  }

  private emit(path: HermitePath, steps: readonly MoveStep[], stretch: number, slowed: readonly Slowed[]): TimedRun {
    const parts: MotionSegment[] = [];
    const out = this.emission;
    out.start(path, stretch);
    let start_s = 0;
    let move = 0;
    const begin = (i: number): void => {
      out.begin(this.knot[i]!, this.s[i]!, i);
    };
    begin(0);
    const close = (): void => {
      const step = steps[move]!;
      const part = out.part(step, start_s);
      parts.push(part);
      start_s += part.duration_s;
      move++;
    };
    for (let i = 0; i + 1 < this.nodes; i++) {
      while (this.owner[i]! > move) {
        close();
        begin(i);
      }
      if (this.s[i + 1]! > this.s[i]!) out.interval(this.s[i + 1]!, i + 1, this.knot[i]!);
    }
    while (move < steps.length) {
      close();
      begin(this.nodes - 1);
    }
    return { parts, slowed, duration_s: start_s };
  }
}

/** Share of a piece at share m of its nodes: closer together at an end that rests (1 the first, 2 the last, 3 both). */
function graded(m: number, rests: number): number {
  switch (rests) {
    case 1:
      return 1 - Math.cos((m * Math.PI) / 2);
    case 2:
      return Math.sin((m * Math.PI) / 2);
    case 3:
      return (1 - Math.cos(m * Math.PI)) / 2;
    default:
      return m;
  }
}
