import { angleBetween, normalizeQuaternion, slerp, type Quaternion } from "../../spatial/quaternion.ts";
import type { Pose } from "../../spatial/pose.ts";
import { distance, subtract, dot, norm, type Vector3 } from "../../spatial/vector.ts";
import { distanceToSegment, pathDeviation, type Deviation } from "../../paths/curve.ts";
import { averagedBeziers, fittedBeziers, meanPoint, pointsOnBeziers, type Bezier } from "./bezier.ts";
import type { Demonstration } from "./demonstration.ts";

export interface FilterOptions {
  /** Samples within this distance of each other for `rest_s` are one stop [m], [s]. */
  readonly rest_m: number;
  readonly rest_s: number;
  /** A stretch whose samples stay this near to its chord is straight [m], [rad]. */
  readonly straight_m: number;
  readonly straight_rad: number;
  /** Straight stretches shorter than this between bends belong to the curve around them [m]. */
  readonly leastStraight_m: number;
  /**
   * "averaged": control points are means of 5 to 10 samples, as published. "fitted": by least squares, nearer to the
   * hand.
   */
  readonly curves: "averaged" | "fitted";
}
/** For a hand with a tremor of a millimetre or two, recorded 50 to 100 times a second. */
export const FILTER_DEFAULTS: FilterOptions = {
  rest_m: 0.003,
  rest_s: 0.2,
  straight_m: 0.002,
  straight_rad: (3 * Math.PI) / 180,
  leastStraight_m: 0.04,
  curves: "fitted",
};

/** What the filters made of consecutive samples; `first` and `last` are their indices, shared with the neighbours. */
export type FilteredPart =
  | { readonly kind: "stop"; readonly first: number; readonly last: number; readonly pose: Pose<"world", "tcp"> }
  | { readonly kind: "straight"; readonly first: number; readonly last: number }
  | {
      readonly kind: "curve";
      readonly first: number;
      readonly last: number;
      readonly beziers: readonly Bezier[];
      /** How many points a curve of the chain is drawn and taught with. */
      readonly perCurve: number;
    };

export interface FilteredDemonstration {
  readonly parts: readonly FilteredPart[];
  /** Points that describe the whole way now: one a stop, the two ends of a straight, the control points of curves. */
  readonly points: number;
  /** The way as a polyline in the world [m]. */
  readonly polyline: readonly Vector3[];
  /** How far the samples lie from that way (row M-47). */
  readonly deviation: Deviation;
}

const PER_CURVE = 6;

/**
 * The three filters (rows M-38 to M-41), in their order: (a) samples of a hand that stands become their mean, x̄ = Σ x
 * / N; (b) of a straight stretch the start and the end are kept; (c) the rest becomes cubic Bézier curves. A change of
 * the grip on the way is a stop of its own. Filters apply to the tracker alone, never to the hand's grip (row M-37).
 *
 * @see Malaya, VR teaching with data glove, Eq 6 and Fig 8.
 */
export function filterDemonstration(
  demonstration: Demonstration,
  options: FilterOptions = FILTER_DEFAULTS,
): FilteredDemonstration {
  const stops = stopsOf(demonstration, options);
  const way = [...demonstration.worldFromTcp];
  for (const { first, last, pose } of stops) for (let i = first; i <= last; i++) way[i] = pose;
  const parts: FilteredPart[] = [];
  let from = 0;
  for (const stop of stops) {
    if (stop.first > from) parts.push(...movingParts(way, from, stop.first, options));
    parts.push({ kind: "stop", ...stop });
    from = stop.last;
  }
  if (from < way.length - 1) parts.push(...movingParts(way, from, way.length - 1, options));
  const polyline = polylineOf(way, parts);
  return {
    parts,
    points: parts.reduce((sum, part) => sum + pointsOf(part), 0),
    polyline,
    deviation: pathDeviation(
      polyline,
      demonstration.worldFromTcp.map(({ position }) => position),
    ),
  };
}

const pointsOf = (part: FilteredPart): number =>
  part.kind === "stop" ? 1 : part.kind === "straight" ? 2 : 3 * part.beziers.length + 1;

interface Stop {
  readonly first: number;
  readonly last: number;
  readonly pose: Pose<"world", "tcp">;
}

/**
 * Filter a: where samples stay within `rest_m` of their running mean for `rest_s`, and where the grip changes on the
 * way.
 */
function stopsOf({ times_s, worldFromTcp, closed }: Demonstration, { rest_m, rest_s }: FilterOptions): Stop[] {
  const stops: Stop[] = [];
  const stopOf = (first: number, last: number): Stop => ({ first, last, pose: meanPose(worldFromTcp, first, last) });
  const last = times_s.length - 1;
  for (let i = 0; i <= last; ) {
    let j = i;
    const sum: Vector3 = [...worldFromTcp[i]!.position];
    while (j < last) {
      const next = worldFromTcp[j + 1]!.position;
      const count = j - i + 1;
      if (distance([sum[0] / count, sum[1] / count, sum[2] / count], next) > rest_m) break;
      for (let k = 0; k < 3; k++) sum[k]! += next[k]!;
      j++;
    }
    if (times_s[j]! - times_s[i]! >= rest_s) {
      stops.push(stopOf(i, j));
      i = j + 1;
    } else {
      if (i > 0 && closed[i] !== closed[i - 1]) stops.push(stopOf(i, i));
      i++;
    }
  }
  return stops;
}

/** x̄ = Σ x / N; orientations on the same half of the sphere, normalised. */
function meanPose(poses: readonly Pose<"world", "tcp">[], first: number, last: number): Pose<"world", "tcp"> {
  const chosen = poses.slice(first, last + 1);
  const [reference] = chosen;
  const sum: Quaternion = [0, 0, 0, 0];
  for (const { quaternion } of chosen) {
    const sign = quaternion.reduce((dots, value, k) => dots + value * reference!.quaternion[k]!, 0) < 0 ? -1 : 1;
    for (let k = 0; k < 4; k++) sum[k]! += sign * quaternion[k]!;
  }
  return { position: meanPoint(chosen.map(({ position }) => position)), quaternion: normalizeQuaternion(sum) };
}

type Way = readonly Pose<"world", "tcp">[];

/** Filters b and c between two stops: the longest straight stretches, and curves over what is left between them. */
function movingParts(way: Way, from: number, to: number, options: FilterOptions): FilteredPart[] {
  const pieces: { first: number; last: number }[] = [];
  for (let first = from; first < to; ) {
    const last = straightUntil(way, first, to, options);
    pieces.push({ first, last });
    first = last;
  }
  const length = ({ first, last }: { first: number; last: number }): number =>
    distance(way[first]!.position, way[last]!.position);
  const parts: FilteredPart[] = [];
  let curveFrom = -1;
  const closeCurve = (at: number): void => {
    if (curveFrom >= 0) parts.push(curveOf(way, curveFrom, at, options));
    curveFrom = -1;
  };
  pieces.forEach((piece, n) => {
    const straight = pieces.length === 1 || (length(piece) >= options.leastStraight_m && !bends(way, pieces, n));
    if (straight) {
      closeCurve(piece.first);
      parts.push({ kind: "straight", ...piece });
    } else if (curveFrom < 0) curveFrom = piece.first;
  });
  closeCurve(to);
  return parts;
}

/** The largest turn between chords of one smooth curve; more is a corner. */
const CORNER_RAD = Math.PI / 6;
/** Chords of one curve are not much longer than each other. */
const SIMILAR = 3;

/** Whether a piece is the chord of a bend: a neighbour of similar length goes on in nearly the same direction. */
function bends(way: Way, pieces: readonly { first: number; last: number }[], n: number): boolean {
  const chord = ({ first, last }: { first: number; last: number }): Vector3 =>
    subtract(way[last]!.position, way[first]!.position);
  const own = chord(pieces[n]!);
  return [pieces[n - 1], pieces[n + 1]].some(neighbour => {
    if (!neighbour) return false;
    const other = chord(neighbour);
    const ratio = norm(own) / Math.max(norm(other), 1e-9);
    const turn = Math.acos(Math.max(-1, Math.min(1, dot(own, other) / Math.max(norm(own) * norm(other), 1e-12))));
    return ratio < SIMILAR && turn > 1e-3 && turn < CORNER_RAD;
  });
}

/**
 * The last sample up to which everything stays near the chord, looked for from the far end: a tremor may spoil a short
 * chord of a line whose long ones are fine.
 */
function straightUntil(way: Way, first: number, to: number, options: FilterOptions): number {
  let good = first + 1;
  let bad = to + 1;
  for (let span = to - first; span > 1; span = Math.floor(0.8 * span)) {
    if (isStraight(way, first, first + span, options)) {
      good = first + span;
      break;
    }
    bad = first + span;
  }
  for (let step = Math.floor((bad - good) / 2); step >= 1; step = Math.floor(step / 2))
    if (isStraight(way, first, good + step, options)) good += step;
  return good;
}

function isStraight(way: Way, first: number, last: number, { straight_m, straight_rad }: FilterOptions): boolean {
  const from = way[first]!;
  const to = way[last]!;
  const length = distance(from.position, to.position);
  let reached = 0;
  for (let i = first + 1; i < last; i++) {
    const { position, quaternion } = way[i]!;
    if (distanceToSegment(from.position, to.position, position) > straight_m) return false;
    const t = length > 0 ? Math.min(1, distance(from.position, position) / length) : 0;
    // Going back along its own line is a way of its own.
    if (t * length < reached - straight_m) return false;
    reached = Math.max(reached, t * length);
    if (angleBetween(quaternion, slerp(from.quaternion, to.quaternion, t)) > straight_rad) return false;
  }
  return true;
}

function curveOf(way: Way, first: number, last: number, options: FilterOptions): FilteredPart {
  const samples = way.slice(first, last + 1).map(({ position }) => position);
  const beziers = options.curves === "averaged" ? averagedBeziers(samples) : fittedBeziers(samples, options.straight_m);
  return { kind: "curve", first, last, beziers, perCurve: PER_CURVE };
}

function polylineOf(way: Way, parts: readonly FilteredPart[]): Vector3[] {
  const points: Vector3[] = [];
  for (const part of parts) {
    if (part.kind === "stop") points.push(part.pose.position);
    else if (part.kind === "straight") points.push(way[part.first]!.position, way[part.last]!.position);
    else points.push(...pointsOnBeziers(part.beziers, part.perCurve));
  }
  return points.filter((point, i) => i === 0 || distance(point, points[i - 1]!) > 1e-9);
}
