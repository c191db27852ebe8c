import type { Pose } from "../spatial/pose.ts";
import { angleBetween, slerp } from "../spatial/quaternion.ts";
import { lerp } from "../spatial/vector.ts";
import { distanceToSegment } from "./curve.ts";

/** A waypoint with the joint angles that reach it. */
export interface JointWaypoint {
  readonly pose: Pose;
  readonly q: Float64Array;
  /** Put in between to stay on the path; the others were given. */
  readonly inserted: boolean;
}

/** What a joint-interpolated move between two neighbouring waypoints does to the path. */
export interface SegmentDeviation {
  /** Index of the waypoint the segment begins with, in the list it belongs to. */
  readonly from: number;
  readonly position_m: number;
  readonly angle_rad: number;
  /** Where in the segment the position is worst, 0 … 1. */
  readonly at: number;
}

export type RefinedPath =
  | {
      readonly kind: "refined";
      readonly points: readonly JointWaypoint[];
      /** With the points given, and with those inserted. */
      readonly before: readonly SegmentDeviation[];
      readonly after: readonly SegmentDeviation[];
    }
  /** A point of the path between two waypoints that no joint angles reach. `sentence` is the reason given. */
  | {
      readonly kind: "unreachable";
      readonly segment: number;
      readonly at: number;
      readonly pose: Pose;
      readonly sentence: string;
    }
  /** The arm must change its posture in the middle of the segment: joint (from 1) jumps however near the points are. */
  | {
      readonly kind: "posture-change";
      readonly segment: number;
      readonly at: number;
      readonly joint: number;
      readonly jump_rad: number;
    }
  | {
      readonly kind: "too-many-points";
      readonly segment: number;
      readonly limit: number;
      readonly position_m: number;
      readonly angle_rad: number;
    };

export interface RefineArm {
  /** Joint angles of a pose, nearest to the given ones; or one sentence why there are none. */
  readonly solve: (pose: Pose, near: Float64Array) => Float64Array | string;
  /** Pose of the TCP. */
  readonly forward: (q: Float64Array, out: Pose) => void;
}

export interface RefineOptions {
  readonly tolerance_m: number;
  readonly tolerance_rad: number;
  /** Limit on points in all. 2000 when absent. */
  readonly maxPoints?: number;
}

/** Instants looked at in a segment: the deviation of a short joint move is one smooth arch, or two in a wrist's S. */
const LOOKS = 12;
/** Halvings after which a jump of the joints is no longer a matter of distance. */
const DEEPEST = 14;
const JUMP_RAD = 0.1;

/**
 * Joint-interpolated motion between sparse points leaves the path (row N-58). Adds points in the middle of segments, on
 * the straight line and the shortest turn between their ends, until the executed TCP path stays within the tolerances.
 *
 * @param waypoints  poses on the path, in order; two neighbours span a straight segment.
 * @param near       joint angles to be near to at the first one.
 */
export function refineJointPath(
  waypoints: readonly Pose[],
  near: ArrayLike<number>,
  arm: RefineArm,
  options: RefineOptions,
): RefinedPath {
  const { tolerance_m, tolerance_rad, maxPoints = 2000 } = options;
  const given: JointWaypoint[] = [];
  let last: Float64Array = Float64Array.from(near);
  for (const [i, pose] of waypoints.entries()) {
    const q = arm.solve(pose, last);
    if (typeof q === "string")
      return { kind: "unreachable", segment: Math.max(0, i - 1), at: i === 0 ? 0 : 1, pose, sentence: q };
    given.push({ pose, q, inserted: false });
    last = q;
  }
  const before = deviationsOf(given, arm);
  const points = given.slice(0, 1);
  for (let segment = 0; segment + 1 < given.length; segment++) {
    // Pieces still to be looked at, the next one on top.
    const open: Piece[] = [{ from: given[segment]!, to: given[segment + 1]!, start: 0, end: 1, depth: 0 }];
    for (let piece = open.pop(); piece; piece = open.pop()) {
      const { position_m, angle_rad } = deviation(piece.from, piece.to, arm);
      if (position_m <= tolerance_m && angle_rad <= tolerance_rad) {
        points.push(piece.to);
        continue;
      }
      const at = (piece.start + piece.end) / 2;
      if (piece.depth >= DEEPEST || (piece.depth > 6 && largestJump(piece.from.q, piece.to.q).jump_rad > JUMP_RAD)) {
        return { kind: "posture-change", segment, at, ...largestJump(piece.from.q, piece.to.q) };
      }
      if (points.length + open.length >= maxPoints)
        return { kind: "too-many-points", segment, limit: maxPoints, position_m, angle_rad };
      const pose = between(piece.from.pose, piece.to.pose);
      const q = arm.solve(pose, piece.from.q);
      if (typeof q === "string") return { kind: "unreachable", segment, at, pose, sentence: q };
      const middle = { pose, q, inserted: true };
      const depth = piece.depth + 1;
      open.push(
        { from: middle, to: piece.to, start: at, end: piece.end, depth },
        { from: piece.from, to: middle, start: piece.start, end: at, depth },
      );
    }
  }
  return { kind: "refined", points, before, after: deviationsOf(points, arm) };
}

interface Piece {
  readonly from: JointWaypoint;
  readonly to: JointWaypoint;
  readonly start: number;
  readonly end: number;
  readonly depth: number;
}

/** The deviations of all segments of a joint-interpolated path, without adding anything. */
export const deviationsOf = (points: readonly JointWaypoint[], arm: Pick<RefineArm, "forward">): SegmentDeviation[] =>
  points.slice(1).map((to, i) => ({ from: i, ...deviation(points[i]!, to, arm) }));

function deviation(
  from: JointWaypoint,
  to: JointWaypoint,
  arm: Pick<RefineArm, "forward">,
): Omit<SegmentDeviation, "from"> {
  const q = new Float64Array(from.q.length);
  const executed: Pose = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
  const a = from.pose;
  const b = to.pose;
  let position_m = 0;
  let angle_rad = 0;
  let at = 0;
  for (let i = 0; i <= LOOKS; i++) {
    const t = i / LOOKS;
    for (let k = 0; k < q.length; k++) q[k] = from.q[k]! + t * (to.q[k]! - from.q[k]!);
    arm.forward(q, executed);
    const off = distanceToSegment(a.position, b.position, executed.position);
    const along = [0, 1, 2].map(k => b.position[k]! - a.position[k]!);
    const squared = along[0]! ** 2 + along[1]! ** 2 + along[2]! ** 2;
    const reached = along.reduce((sum, v, k) => sum + v * (executed.position[k]! - a.position[k]!), 0);
    // The tool's wanted direction belongs to the spot, not to the instant: speed along the edge does not matter.
    const share = squared > 1e-18 ? Math.min(1, Math.max(0, reached / squared)) : t;
    angle_rad = Math.max(angle_rad, angleBetween(executed.quaternion, slerp(a.quaternion, b.quaternion, share)));
    if (off > position_m) {
      position_m = off;
      at = t;
    }
  }
  return { position_m, angle_rad, at };
}

const between = (a: Pose, b: Pose): Pose => ({
  position: lerp(a.position, b.position, 0.5),
  quaternion: slerp(a.quaternion, b.quaternion, 0.5),
});

function largestJump(a: Float64Array, b: Float64Array): { joint: number; jump_rad: number } {
  let joint = 0;
  let jump_rad = 0;
  a.forEach((value, i) => {
    const jump = Math.abs(b[i]! - value);
    if (jump > jump_rad) {
      jump_rad = jump;
      joint = i + 1;
    }
  });
  return { joint, jump_rad };
}
