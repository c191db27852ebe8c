import type { Pose } from "../spatial/pose.ts";
import { transformPoint } from "../spatial/pose.ts";
import { rotate } from "../spatial/quaternion.ts";
import { distance, dot, lerp, subtract, type Vector3 } from "../spatial/vector.ts";
import type { EdgeChain } from "./features.ts";
import type { EdgeLoop } from "./pick.ts";

/** A line to follow and the surfaces beside it. n + 1 points, n segments, one pair of normals a segment. */
export interface EdgeCurve {
  readonly points: readonly Vector3[];
  /** Outward unit normals of the face the tool's tilt is measured from. */
  readonly first: readonly Vector3[];
  /** Outward unit normals of the face on the other side. */
  readonly second: readonly Vector3[];
  readonly closed: boolean;
}

/**
 * A chain as a curve, run with its first face on the left: the first face is the one that looks most along `prefer`.
 */
export function curveOfChain(chain: EdgeChain, prefer: Vector3): EdgeCurve {
  let leftLooks = 0;
  chain.left.forEach((normal, i) => {
    leftLooks += dot(normal, prefer) - dot(chain.right[i]!, prefer);
  });
  const { points, left, right, closed } = chain;
  return leftLooks >= 0
    ? { points, first: left, second: right, closed }
    : { points: [...points].reverse(), first: [...right].reverse(), second: [...left].reverse(), closed };
}

/** The edges around a face, in order, each with that face as its first: input of `traceEdges`. */
export const curvesOfLoop = ({ chains }: EdgeLoop): EdgeCurve[] =>
  chains.map(({ chain, reversed }) => {
    const { points, left, right, closed } = chain;
    return reversed
      ? { points: [...points].reverse(), first: [...right].reverse(), second: [...left].reverse(), closed }
      : { points, first: left, second: right, closed };
  });

/**
 * An auxiliary curve that is no edge of a part (row N-60): any line with the surface normal at its points.
 *
 * @param normalAt  outward unit normal at a point, from a helper surface or a constant.
 */
export function helperCurve(
  points: readonly Vector3[],
  normalAt: (point: Vector3) => Vector3,
  closed = false,
): EdgeCurve {
  const normals = points.slice(1).map((point, i) => {
    const before = points[i]!;
    return normalAt([(before[0] + point[0]) / 2, (before[1] + point[1]) / 2, (before[2] + point[2]) / 2]);
  });
  return { points, first: normals, second: normals, closed };
}

/** The same curve seen in another frame: from the part's mesh into the world. */
export function moveCurve(curve: EdgeCurve, intoFromCurve: Pose): EdgeCurve {
  const turn = (normal: Vector3): Vector3 => rotate(intoFromCurve.quaternion, normal);
  return {
    points: curve.points.map(point => transformPoint(intoFromCurve, point)),
    first: curve.first.map(turn),
    second: curve.second.map(turn),
    closed: curve.closed,
  };
}

/** How far points are from a line: the largest, the root mean square, and where [m]. */
export interface Deviation {
  readonly max_m: number;
  readonly rms_m: number;
  readonly at: number;
}

/** Distance of each point from the nearest spot of a polyline, summed up. `at` is the index of the worst point. */
export function pathDeviation(polyline: readonly Vector3[], points: readonly Vector3[]): Deviation {
  let max_m = 0;
  let squares = 0;
  let at = 0;
  const distanceTo = distancesTo(polyline);
  points.forEach((point, i) => {
    const d = distanceTo(point);
    squares += d * d;
    if (d > max_m) {
      max_m = d;
      at = i;
    }
  });
  return { max_m, rms_m: points.length > 0 ? Math.sqrt(squares / points.length) : 0, at };
}

/** So many segments are looked at or left out together. */
const RUN = 32;

/**
 * Distances of many points, neighbours near each other, from the nearest spot of a polyline [m]. Runs of segments that
 * lie in a ball no nearer than the best so far are left out, so that long ways cost about as much as their ends.
 */
function distancesTo(polyline: readonly Vector3[]): (point: Vector3) => number {
  const runs: { readonly from: number; readonly to: number; readonly centre: Vector3; readonly radius_m: number }[] =
    [];
  for (let from = 0; from < polyline.length - 1; from += RUN) {
    const to = Math.min(from + RUN, polyline.length - 1);
    const corners = polyline.slice(from, to + 1);
    const centre = lerp(corners[0]!, corners.at(-1)!, 0.5);
    runs.push({ from, to, centre, radius_m: Math.max(...corners.map(corner => distance(centre, corner))) });
  }
  let last = 0;
  return point => {
    if (runs.length === 0) return distanceToPolyline(polyline, point);
    let least = Infinity;
    let nearest = last;
    const look = (n: number): void => {
      const { from, to, centre, radius_m } = runs[n]!;
      if (distance(point, centre) - radius_m >= least) return;
      for (let i = from; i < to; i++) {
        const d = distanceToSegment(polyline[i]!, polyline[i + 1]!, point);
        if (d >= least) continue;
        least = d;
        nearest = n;
      }
    };
    look(last);
    for (let n = 0; n < runs.length; n++) if (n !== last) look(n);
    last = nearest;
    return least;
  };
}

/** Distance of a point from the nearest spot of a polyline [m]. */
export function distanceToPolyline(polyline: readonly Vector3[], point: Vector3): number {
  let least = polyline.length > 0 ? distance(point, polyline[0]!) : Infinity;
  for (let i = 1; i < polyline.length; i++)
    least = Math.min(least, distanceToSegment(polyline[i - 1]!, polyline[i]!, point));
  return least;
}

/** The spot of a polyline that is nearest to a point; the point itself for one without points. */
export function nearestOnPolyline(polyline: readonly Vector3[], point: Vector3): Vector3 {
  let best = polyline[0] ?? point;
  let least = distance(point, best);
  for (let i = 1; i < polyline.length; i++) {
    const [a, b] = [polyline[i - 1]!, polyline[i]!];
    const along = subtract(b, a);
    const squared = dot(along, along);
    const t = squared > 0 ? Math.min(1, Math.max(0, dot(subtract(point, a), along) / squared)) : 0;
    const spot: Vector3 = [a[0] + t * along[0], a[1] + t * along[1], a[2] + t * along[2]];
    const away = distance(point, spot);
    if (away >= least) continue;
    least = away;
    best = spot;
  }
  return best;
}

export function distanceToSegment(a: Vector3, b: Vector3, point: Vector3): number {
  const along = subtract(b, a);
  const from = subtract(point, a);
  const squared = dot(along, along);
  const t = squared > 0 ? Math.min(1, Math.max(0, dot(from, along) / squared)) : 0;
  return Math.hypot(from[0] - t * along[0], from[1] - t * along[1], from[2] - t * along[2]);
}
