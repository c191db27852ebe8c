import { Follower } from "./follow.ts";
import { offsetInBase, posePoint, poseTwist, shiftTwist, geometryScratch, type PosePath } from "./geometry.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** A stretch of the path without kinks in q′; q″ may jump between pieces. Node indices are inclusive. */
export interface Piece {
  readonly first: number;
  readonly last: number;
  /** Moves it belongs to, up to and from `split` (a place along s). The same twice outside a blend. */
  readonly before: number;
  readonly after: number;
  readonly split: number;
}

/** Why a pose path could not be followed, and how far along it. */
export type Stop = {
  readonly kind: "out-of-reach" | "posture-jump";
  readonly s: number;
  readonly goal: Pose<"base", "flange">;
};

/** Intervals of one pose path at most; a path that needs more passes a singular posture. */
const MOST_INTERVALS = 2048;
/** Substeps on the way to a node that Newton does not reach in one go. */
const SUBSTEPS = 16;

/**
 * A path of a whole run of moves in joint space: q(s) as cubic Hermite curves on nodes that are dense enough for the
 * TCP to stay within `tolerance_m` of the commanded path. Grows as pieces are added; `clear` makes it empty again.
 */
export class HermitePath {
  readonly joints: number;
  nodes = 0;
  s: Float64Array;
  q: Float64Array;
  /** dq/ds and d²q/ds². */
  q1: Float64Array;
  q2: Float64Array;
  /** |dp/ds| of the TCP at each node. */
  tcp: Float64Array;
  pieces: Piece[] = [];
  private readonly follower: Follower;
  private readonly tolerance_m: number;
  private readonly scratch = geometryScratch();
  private readonly twist = new Float64Array(6);
  private readonly tcpPose: Pose<"base", "tcp"> = identity();
  private readonly goal: Pose<"base", "flange"> = identity();
  private readonly offset: Vector3 = [0, 0, 0];
  private readonly speeds: Float64Array;
  private readonly middle: Float64Array;

  constructor(follower: Follower, tolerance_m: number) {
    const n = follower.arm.joints.length;
    this.follower = follower;
    this.tolerance_m = tolerance_m;
    this.joints = n;
    this.s = new Float64Array(64);
    this.tcp = new Float64Array(64);
    this.q = new Float64Array(64 * n);
    this.q1 = new Float64Array(64 * n);
    this.q2 = new Float64Array(64 * n);
    this.speeds = new Float64Array(n);
    this.middle = new Float64Array(n);
  }

  clear(): void {
    this.nodes = 0;
    this.pieces = [];
  }
  get length(): number {
    return this.nodes === 0 ? 0 : this.s[this.nodes - 1]!;
  }

  /** Adds one piece of two nodes: a cubic in joint space, which a straight joint line is as well. */
  addJoints(
    q0: ArrayLike<number>,
    d0: ArrayLike<number>,
    q1: ArrayLike<number>,
    d1: ArrayLike<number>,
    length: number,
    before: number,
    after: number,
  ): void {
    const n = this.joints;
    const s0 = this.length;
    const first = this.node(s0);
    const last = this.node(s0 + length);
    for (let j = 0; j < n; j++) {
      const a = first * n + j;
      const b = last * n + j;
      const rise = (q1[j]! - q0[j]!) / length;
      this.q[a] = q0[j]!;
      this.q[b] = q1[j]!;
      this.q1[a] = d0[j]!;
      this.q1[b] = d1[j]!;
      this.q2[a] = (6 * rise - 4 * d0[j]! - 2 * d1[j]!) / length;
      this.q2[b] = (-6 * rise + 2 * d0[j]! + 4 * d1[j]!) / length;
    }
    this.tcp[first] = this.tcp[last] = 0;
    this.pieces.push({ first, last, before, after, split: s0 + length / 2 });
  }

  /**
   * Adds the part of a pose path from `from` to `to`.
   *
   * @param q  posture at `from`; receives the posture at `to`. On a stop: the last posture reached.
   */
  addPoses(
    path: PosePath,
    tcpFromFlange: Pose<"tcp", "flange">,
    from: number,
    to: number,
    q: Float64Array,
    before: number,
    after: number,
  ): Stop | undefined {
    const n = this.joints;
    const s0 = this.length;
    const first = this.nodes;
    const start = q.slice();
    for (let count = 2; ; count *= 2) {
      this.nodes = first;
      q.set(start);
      const h = (to - from) / count;
      let stop: Stop | undefined;
      for (let k = 0; k <= count && stop === undefined; k++) {
        const s = from + h * k;
        if (k > 0) for (let j = 0; j < n; j++) q[j]! += this.q1[(this.nodes - 1) * n + j]! * h;
        if (!this.reach(path, tcpFromFlange, s, q)) {
          const blocked = k > 0 ? this.creep(path, tcpFromFlange, s - h, s, q) : s;
          if (blocked !== undefined) {
            stop = { kind: "out-of-reach", s: blocked, goal: copyOf(this.goal) };
            break;
          }
        }
        this.addNode(path, tcpFromFlange, s, s0 + h * k, q);
      }
      if (stop !== undefined) {
        this.nodes = first;
        return stop;
      }
      const worst = this.worstInterval(path, tcpFromFlange, from, first, h, count);
      if (worst < 0) {
        this.bend(first, count, h);
        this.pieces.push({ first, last: this.nodes - 1, before, after, split: s0 + (to - from) / 2 });
        return undefined;
      }
      if (count >= MOST_INTERVALS) {
        posePoint(path, from + h * worst, this.tcpPose, this.scratch);
        compose(this.tcpPose, tcpFromFlange, this.goal);
        this.nodes = first;
        return { kind: "posture-jump", s: from + h * worst, goal: copyOf(this.goal) };
      }
    }
  }

  /** Turns `q`, a posture nearby, to the pose at s. */
  reach(path: PosePath, tcpFromFlange: Pose<"tcp", "flange">, s: number, q: Float64Array): boolean {
    posePoint(path, s, this.tcpPose, this.scratch);
    compose(this.tcpPose, tcpFromFlange, this.goal);
    return this.follower.meet(this.goal, q);
  }

  /**
   * The same in small steps from s0, where the last node is. Returns the place that cannot be reached, if there is one.
   */
  private creep(
    path: PosePath,
    tcpFromFlange: Pose<"tcp", "flange">,
    s0: number,
    s: number,
    q: Float64Array,
  ): number | undefined {
    const n = this.joints;
    const at = (this.nodes - 1) * n;
    for (let j = 0; j < n; j++) q[j] = this.q[at + j]!;
    for (let k = 1; k <= SUBSTEPS; k++) {
      const place = s0 + ((s - s0) * k) / SUBSTEPS;
      if (!this.reach(path, tcpFromFlange, place, q)) return place;
    }
    return undefined;
  }

  /** dq/ds of a posture on a pose path at s. Returns |dp/ds| of the TCP. `met`: `reach` has just put q there. */
  slope(
    path: PosePath,
    tcpFromFlange: Pose<"tcp", "flange">,
    s: number,
    q: ArrayLike<number>,
    out: Float64Array,
    met = false,
  ): number {
    if (!met) posePoint(path, s, this.tcpPose, this.scratch);
    poseTwist(path, s, this.twist, this.scratch);
    const t = this.twist;
    const speed = Math.sqrt(t[0]! * t[0]! + t[1]! * t[1]! + t[2]! * t[2]!);
    shiftTwist(this.twist, offsetInBase(this.tcpPose, tcpFromFlange, this.offset));
    this.follower.speeds(q, this.twist, out, met);
    return speed;
  }

  private addNode(
    path: PosePath,
    tcpFromFlange: Pose<"tcp", "flange">,
    s: number,
    place: number,
    q: Float64Array,
  ): void {
    const at = this.node(place);
    const n = this.joints;
    this.tcp[at] = this.slope(path, tcpFromFlange, s, q, this.speeds, true);
    this.q.set(q, at * n);
    this.q1.set(this.speeds, at * n);
  }

  /** The interval whose middle is farthest off the path, or −1 when all are within tolerance. */
  private worstInterval(
    path: PosePath,
    tcpFromFlange: Pose<"tcp", "flange">,
    from: number,
    first: number,
    h: number,
    count: number,
  ): number {
    const n = this.joints;
    const middle = this.middle;
    let worst = -1;
    let far = this.tolerance_m;
    for (let k = 0; k < count; k++) {
      const a = (first + k) * n;
      const b = a + n;
      for (let j = 0; j < n; j++)
        middle[j] = (this.q[a + j]! + this.q[b + j]!) / 2 + (h * (this.q1[a + j]! - this.q1[b + j]!)) / 8;
      posePoint(path, from + h * (k + 0.5), this.tcpPose, this.scratch);
      compose(this.tcpPose, tcpFromFlange, this.goal);
      const miss = this.follower.miss(middle, this.goal);
      if (!(miss <= far)) {
        far = miss;
        worst = k;
      }
    }
    return worst;
  }

  /** q″ from the slopes: central differences, second order at the ends as well. */
  private bend(first: number, count: number, h: number): void {
    const n = this.joints;
    const d = this.q1;
    for (let k = 0; k <= count; k++) {
      const at = (first + k) * n;
      for (let j = 0; j < n; j++) {
        const i = at + j;
        this.q2[i] =
          k === 0
            ? (-3 * d[i]! + 4 * d[i + n]! - d[i + 2 * n]!) / (2 * h)
            : k === count
              ? (3 * d[i]! - 4 * d[i - n]! + d[i - 2 * n]!) / (2 * h)
              : (d[i + n]! - d[i - n]!) / (2 * h);
      }
    }
  }

  private node(s: number): number {
    const at = this.nodes++;
    const n = this.joints;
    if (at >= this.s.length) {
      const more = this.s.length * 2;
      this.s = grown(this.s, more);
      this.tcp = grown(this.tcp, more);
      this.q = grown(this.q, more * n);
      this.q1 = grown(this.q1, more * n);
      this.q2 = grown(this.q2, more * n);
    }
    this.s[at] = s;
    return at;
  }

  /**
   * Joint angles, slopes and bends at s inside the interval behind node i.
   *
   * @param out @param out1 @param out2  n numbers each, from `at` on.
   */
  evaluate(i: number, s: number, at: number, out: Float64Array, out1: Float64Array, out2: Float64Array): void {
    const n = this.joints;
    const h = this.s[i + 1]! - this.s[i]!;
    const u = (s - this.s[i]!) / h;
    const u2 = u * u;
    const u3 = u2 * u;
    const h01 = 3 * u2 - 2 * u3;
    const h10 = (u3 - 2 * u2 + u) * h;
    const h11 = (u3 - u2) * h;
    const g01 = (6 * u - 6 * u2) / h;
    const g10 = 3 * u2 - 4 * u + 1;
    const g11 = 3 * u2 - 2 * u;
    for (let j = 0; j < n; j++) {
      const a = i * n + j;
      const b = a + n;
      const qa = this.q[a]!;
      const qb = this.q[b]!;
      const da = this.q1[a]!;
      const db = this.q1[b]!;
      out[at + j] = qa + (qb - qa) * h01 + da * h10 + db * h11;
      out1[at + j] = (qb - qa) * g01 + da * g10 + db * g11;
      out2[at + j] = this.q2[a]! + (this.q2[b]! - this.q2[a]!) * u;
    }
  }
}

function grown(from: Float64Array, length: number): Float64Array<ArrayBuffer> {
  const to = new Float64Array(length);
  to.set(from);
  return to;
}

const copyOf = (goal: Pose<"base", "flange">): Pose<"base", "flange"> => ({
  position: [...goal.position],
  quaternion: [...goal.quaternion],
});
