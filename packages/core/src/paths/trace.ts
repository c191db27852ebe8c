import type { Pose } from "../spatial/pose.ts";
import { angleBetween, fromMatrix, slerp, type Quaternion } from "../spatial/quaternion.ts";
import { add, addScaled, cross, distance, dot, normalize, subtract, type Vector3 } from "../spatial/vector.ts";
import { distanceToSegment, type EdgeCurve } from "./curve.ts";

export interface TraceOptions {
  /**
   * Where the tool comes from, in the plane across the edge: 0 lies in the first face's plane beyond the edge, 90°
   * stands on the first face. On a right-angled edge 45° halves the corner.
   */
  readonly tilt_rad: number;
  /** How far a straight line between neighbouring points may leave the edge [m]. */
  readonly chord_m: number;
  /** And how far the tool may turn away from its wanted direction there [rad]. 1° when absent. */
  readonly chord_rad?: number;
  /** Turn about the tool's own axis, from the x axis along the edge [rad]. */
  readonly spin_rad?: number;
  /**
   * "along": x follows the edge, so the tool turns at every corner. A direction: x stays as near to it as the tool axis
   * allows, which spares the wrist when the tool is round.
   */
  readonly xAxis?: "along" | Vector3;
  /** Retreat against the tool axis before and after [m]. 0: no such point. */
  readonly leadIn_m?: number;
  readonly leadOut_m?: number;
  /** Lead-in and lead-out points also lie this far before and behind the edge, along it [m]. */
  readonly overrun_m?: number;
  /** Between edges that meet: "retract" leads out and in again, "swing" turns the tool on the spot. */
  readonly corners?: "retract" | "swing";
  /** No two neighbouring points farther apart than this [m]. */
  readonly maxStep_m?: number;
}

export interface TracePoint {
  readonly pose: Pose<"part", "tcp">;
  readonly onEdge: boolean;
  readonly role: "lead-in" | "edge" | "lead-out";
}

/** The points of one edge, in order, in the frame of its curve. */
export interface TracedEdge {
  readonly points: readonly TracePoint[];
  /** Unit direction of travel at the beginning. */
  readonly tangent: Vector3;
  /** The edge itself, for drawing and for measuring deviations. */
  readonly polyline: readonly Vector3[];
}

const SAME_SPOT_M = 1e-6;

/**
 * Waypoints of the TCP along edges. TCP z points into the work piece, x along the edge (turned by `spin_rad`).
 *
 *   approach = sin(tilt) n₁ + cos(tilt) w,   tcp z = −approach,
 *
 * where n₁ is the outward normal of the first face and w lies in that face, across the edge, away from its material.
 * A straight edge needs its two ends; a curved one gets as many of its own points as `chord_m` and `chord_rad` ask for.
 * Where two edges meet, the corner is taught twice, once with the tool of either edge.
 */
export function traceEdges(curves: readonly EdgeCurve[], options: TraceOptions): TracedEdge[] {
  const swing = options.corners === "swing";
  const meets = curves.map((curve, i) => {
    const next = curves[(i + 1) % curves.length]!;
    return curves.length > 1 && distance(curve.points.at(-1)!, next.points[0]!) < SAME_SPOT_M;
  });
  return curves.map((curve, i) => {
    const stations = stationsOf(curve, options);
    const kept = thin(stations, options);
    const first = kept[0]!;
    const last = kept.at(-1)!;
    const points: TracePoint[] = [];
    const { leadIn_m = 0, leadOut_m = 0, overrun_m = 0 } = options;
    // The loop's own beginning and end keep their leads: there the tool comes from and goes elsewhere.
    if (leadIn_m > 0 && !(swing && i > 0 && meets[i - 1])) points.push(lead(first, leadIn_m, -overrun_m, "lead-in"));
    for (const station of kept) points.push({ pose: poseOf(station), onEdge: true, role: "edge" });
    if (leadOut_m > 0 && !(swing && i + 1 < curves.length && meets[i]))
      points.push(lead(last, leadOut_m, overrun_m, "lead-out"));
    return { points, tangent: first.tangent, polyline: curve.points };
  });
}

/** A point of the curve with the tool standing on it. */
interface Station {
  readonly point: Vector3;
  readonly tangent: Vector3;
  readonly approach: Vector3;
  readonly quaternion: Quaternion;
}

const poseOf = ({ point, quaternion }: Station): Pose<"part", "tcp"> => ({
  position: [...point],
  quaternion: [...quaternion],
});

function lead(station: Station, back_m: number, along_m: number, role: "lead-in" | "lead-out"): TracePoint {
  const position = addScaled(addScaled(station.point, station.approach, back_m), station.tangent, along_m);
  return { pose: { position, quaternion: [...station.quaternion] }, onEdge: false, role };
}

function stationsOf({ points, first, second, closed }: EdgeCurve, options: TraceOptions): Station[] {
  const directions = first.map((_, i) => normalize(subtract(points[i + 1]!, points[i]!)));
  /** Mean over the segments before and after a point; at open ends there is only one. */
  const mean = (of: readonly Vector3[], i: number): Vector3 => {
    const n = of.length;
    const before = i > 0 ? of[i - 1] : closed ? of[n - 1] : undefined;
    const after = i < n ? of[i] : closed ? of[0] : undefined;
    return before && after ? normalize(add(before, after)) : [...(before ?? after)!];
  };
  return points.map((point, i) => {
    const tangent = mean(directions, i);
    const firstNormal = mean(first, i);
    const n1 = normalize(addScaled(firstNormal, tangent, -dot(firstNormal, tangent)));
    // Across the edge in the first face; the other normal tells which way is out. Where it does not, material is on the
    // left.
    const sideways = cross(tangent, n1);
    const out = dot(sideways, mean(second, i));
    const w: Vector3 = out < -1e-9 ? [-sideways[0], -sideways[1], -sideways[2]] : sideways;
    const s = Math.sin(options.tilt_rad);
    const c = Math.cos(options.tilt_rad);
    const approach = normalize([s * n1[0] + c * w[0], s * n1[1] + c * w[1], s * n1[2] + c * w[2]]);
    return { point, tangent, approach, quaternion: toolFrame(approach, tangent, options) };
  });
}

/** z = −approach; x the wanted direction made square to z and turned by the spin; y = z × x. */
function toolFrame(approach: Vector3, tangent: Vector3, { xAxis = "along", spin_rad = 0 }: TraceOptions): Quaternion {
  const z: Vector3 = [-approach[0], -approach[1], -approach[2]];
  let wanted = xAxis === "along" ? tangent : xAxis;
  if (Math.abs(dot(normalize(wanted), z)) > 0.999) wanted = tangent;
  const u = normalize(addScaled(wanted, z, -dot(wanted, z)));
  const v = cross(z, u);
  const c = Math.cos(spin_rad);
  const s = Math.sin(spin_rad);
  const x = [c * u[0] + s * v[0], c * u[1] + s * v[1], c * u[2] + s * v[2]] as Vector3;
  const y = cross(z, x);
  return fromMatrix([x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]]);
}

/**
 * Keeps the stations that straight lines between them need (Douglas and Peucker 1973), with the tool's turn counted
 * too.
 */
function thin(stations: readonly Station[], options: TraceOptions): Station[] {
  const { chord_m, chord_rad = Math.PI / 180, maxStep_m = Infinity } = options;
  const lengths = [0];
  for (let i = 1; i < stations.length; i++)
    lengths.push(lengths[i - 1]! + distance(stations[i - 1]!.point, stations[i]!.point));
  const kept: Station[] = [stations[0]!];
  const open: [number, number][] = [[0, stations.length - 1]];
  for (let range = open.pop(); range; range = open.pop()) {
    const [from, to] = range;
    const a = stations[from]!;
    const b = stations[to]!;
    let worst = 1;
    let at = -1;
    for (let i = from + 1; i < to; i++) {
      const share = (lengths[i]! - lengths[from]!) / (lengths[to]! - lengths[from]!);
      const off = distanceToSegment(a.point, b.point, stations[i]!.point) / chord_m;
      const turned = angleBetween(stations[i]!.quaternion, slerp(a.quaternion, b.quaternion, share)) / chord_rad;
      if (Math.max(off, turned) > worst) {
        worst = Math.max(off, turned);
        at = i;
      }
    }
    if (at >= 0) {
      open.push([at, to], [from, at]);
      continue;
    }
    const pieces = Math.max(1, Math.ceil(distance(a.point, b.point) / maxStep_m - 1e-9));
    for (let k = 1; k < pieces; k++) kept.push(blend(a, b, k / pieces));
    kept.push(b);
  }
  return kept;
}

function blend(a: Station, b: Station, t: number): Station {
  const mix = (p: Vector3, q: Vector3): Vector3 => [
    p[0] + t * (q[0] - p[0]),
    p[1] + t * (q[1] - p[1]),
    p[2] + t * (q[2] - p[2]),
  ];
  return {
    point: mix(a.point, b.point),
    tangent: normalize(mix(a.tangent, b.tangent)),
    approach: normalize(mix(a.approach, b.approach)),
    quaternion: slerp(a.quaternion, b.quaternion, t),
  };
}
