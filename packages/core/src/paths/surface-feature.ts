import { symmetricEigen } from "../spatial/eigen.ts";
import {
  add,
  addScaled,
  cross,
  distance,
  dot,
  norm,
  normalize,
  scale,
  subtract,
  type Vector3,
} from "../spatial/vector.ts";
import { vertexPoint, type FeatureEdges } from "./features.ts";
import { triangleDistanceOfPoint } from "./nearest-triangle.ts";
import { fromVertex, triangleOf, type Topology } from "./topology.ts";

/**
 * What a person points at on a part, in the frame of its mesh [m]. `axis` is a unit vector: that of a cylinder or
 * circle, with its largest component above 0; of a plane the outward normal.
 */
export type SurfaceFeature =
  | {
      readonly kind: "cylinder";
      /** Middle of the length that the surface covers. */
      readonly center_m: Vector3;
      readonly axis: Vector3;
      readonly radius_m: number;
      readonly length_m: number;
      /** A bore: the material is outside. */
      readonly inside: boolean;
    }
  | { readonly kind: "circle"; readonly center_m: Vector3; readonly axis: Vector3; readonly radius_m: number }
  | { readonly kind: "plane"; readonly center_m: Vector3; readonly axis: Vector3 };

/** Neighbours that bend less than this are one plane [rad]; a cylinder of 1000 facets bends by 0.006. */
const FLAT_COSINE = Math.cos(0.003);
/** Neighbours that bend more are an edge: a cylinder drawn with 12 facets bends by 0.52. */
const SMOOTH_COSINE = Math.cos(0.6);
/** Corners are on the circle within this share of its radius. */
const ROUND_SHARE = 1e-3;
/** Facets of a cylinder stand along its axis: |n · a| at most. */
const ALONG = 0.01;
/** A piece of a cylinder must turn by this much, and in so many facets, to be told from a chamfer or fillet's strip. */
const LEAST_TURN_RAD = 0.7;
const LEAST_FACETS = 3;
/** The strip between two meridians of a ball lies on a cylinder, nearly: what does not go all round must be longer. */
const ALL_ROUND_RAD = 1.8 * Math.PI;
const LEAST_LENGTH_SHARE = 0.2;
/** An edge must have this many points to be a circle, and turn by a right angle. */
const LEAST_POINTS = 7;
const LEAST_ARC_RAD = Math.PI / 2;

/**
 * The cylinder, the circle or the plane that a point of a surface belongs to: the cylinder its facets lie on, else a
 * round edge within `near_m`, else the plane of the triangle there.
 *
 *   axis of a cylinder: the direction in which its normals spread least, least eigenvector of Σ n nᵀ
 *   circle through points p of a plane (Kåsa 1976): min Σ ( |p − c|² − r² )², linear in c and r² − |c|²
 *
 * @param edges   of the mesh, with its topology; the frame of all numbers is the mesh's.
 * @param point   on the surface [m].
 * @param near_m  a circle is taken within this distance of the point.
 * @returns undefined for a mesh without triangles.
 */
export function surfaceFeatureAt(edges: FeatureEdges, point: Vector3, near_m: number): SurfaceFeature | undefined {
  const { topology } = edges;
  const triangle = nearestTriangle(topology, point);
  if (triangle < 0) return undefined;
  return (
    cylinderAt(topology, triangle) ??
    circleNear(edges, point, near_m) ?? { kind: "plane", center_m: point, axis: normalOf(topology, triangle) }
  );
}

function nearestTriangle({ mesh: { positions, indices } }: Topology, point: Vector3): number {
  let best = -1;
  let least = Infinity;
  for (let t = 0; t < indices.length / 3; t++) {
    const corners = [indices[3 * t]!, indices[3 * t + 1]!, indices[3 * t + 2]!] as const;
    const squared = triangleDistanceOfPoint(positions, corners, point, least);
    if (squared < least) {
      least = squared;
      best = t;
    }
  }
  return best;
}

const normalOf = ({ normals }: Topology, t: number): Vector3 => [
  normals[3 * t]!,
  normals[3 * t + 1]!,
  normals[3 * t + 2]!,
];

/** Triangles that hang together with the first and are let in, the first included. */
function flood(topology: Topology, first: number, lets: (t: number, from: number) => boolean): number[] {
  const seen = new Set([first]);
  const found = [first];
  for (const t of found)
    for (let h = 3 * t; h < 3 * t + 3; h++) {
      const twin = topology.twins[h]!;
      if (twin < 0) continue;
      const next = triangleOf(twin);
      if (seen.has(next) || !lets(next, t)) continue;
      seen.add(next);
      found.push(next);
    }
  return found;
}

interface Candidate {
  readonly triangles: readonly number[];
  readonly axis: Vector3;
}

/** The largest piece of a cylinder that the facet of this triangle is part of, tried with every facet beside it. */
function cylinderAt(topology: Topology, first: number): SurfaceFeature | undefined {
  const own = normalOf(topology, first);
  const facet = flood(topology, first, t => dot(normalOf(topology, t), own) >= FLAT_COSINE);
  const inFacet = new Set(facet);
  let best: Candidate | undefined;
  const tried: Vector3[] = [];
  for (const t of facet)
    for (let h = 3 * t; h < 3 * t + 3; h++) {
      const twin = topology.twins[h]!;
      if (twin < 0 || inFacet.has(triangleOf(twin))) continue;
      const beside = normalOf(topology, triangleOf(twin));
      const bend = dot(beside, own);
      if (bend < SMOOTH_COSINE || bend >= FLAT_COSINE) continue;
      if (tried.some(normal => dot(normal, beside) >= FLAT_COSINE)) continue;
      tried.push(beside);
      const candidate = grown(topology, first, triangleOf(twin), normalize(cross(own, beside)));
      if (candidate.triangles.length > (best?.triangles.length ?? 0)) best = candidate;
    }
  return best && cylinderOf(topology, best);
}

/** From two neighbouring facets: the circle through their corners, and everything connected that lies on it. */
function grown(topology: Topology, first: number, beside: number, axis: Vector3): Candidate {
  const [u, v] = acrossOf(axis);
  const circle = circleIn(cornersOf(topology, [first, beside]), u, v);
  if (!circle) return { triangles: [], axis };
  const tolerance = circle.radius_m * ROUND_SHARE;
  const isOn = (corner: Vector3): boolean =>
    Math.abs(Math.hypot(dot(corner, u) - circle.x, dot(corner, v) - circle.y) - circle.radius_m) <= tolerance;
  const triangles = flood(topology, first, t => {
    if (Math.abs(dot(normalOf(topology, t), axis)) > ALONG) return false;
    return cornersOf(topology, [t]).every(isOn);
  });
  return { triangles, axis };
}

function cylinderOf(topology: Topology, { triangles, axis }: Candidate): SurfaceFeature | undefined {
  const normals = facetNormals(topology, triangles);
  const turn_rad = turnOf(normals, axis);
  if (normals.length < LEAST_FACETS || turn_rad < LEAST_TURN_RAD) return undefined;
  const fine = positive(leastSpread(normals));
  const [u, v] = acrossOf(fine);
  const corners = cornersOf(topology, triangles);
  const circle = circleIn(corners, u, v);
  if (!circle) return undefined;
  let lower = Infinity;
  let upper = -Infinity;
  for (const corner of corners) {
    lower = Math.min(lower, dot(corner, fine));
    upper = Math.max(upper, dot(corner, fine));
  }
  if (turn_rad < ALL_ROUND_RAD && upper - lower < LEAST_LENGTH_SHARE * circle.radius_m) return undefined;
  const foot = add(scale(u, circle.x), scale(v, circle.y));
  const center_m = addScaled(foot, fine, (lower + upper) / 2);
  const outward = normalOf(topology, triangles[0]!);
  const [corner] = cornersOf(topology, [triangles[0]!]);
  return {
    kind: "cylinder",
    center_m,
    axis: fine,
    radius_m: circle.radius_m,
    length_m: upper - lower,
    inside: dot(outward, subtract(corner!, center_m)) < 0,
  };
}

/** One normal a facet. */
function facetNormals(topology: Topology, triangles: readonly number[]): Vector3[] {
  const found: Vector3[] = [];
  for (const t of triangles) {
    const normal = normalOf(topology, t);
    if (!found.some(other => dot(other, normal) >= FLAT_COSINE)) found.push(normal);
  }
  return found;
}

/** How far directions across an axis turn about it, from one end of their arc to the other [rad]. */
function turnOf(directions: readonly Vector3[], axis: Vector3): number {
  const [u, v] = acrossOf(axis);
  const angles = directions.map(each => Math.atan2(dot(each, v), dot(each, u))).sort((a, b) => a - b);
  let gap = angles[0]! + 2 * Math.PI - angles.at(-1)!;
  for (let i = 1; i < angles.length; i++) gap = Math.max(gap, angles[i]! - angles[i - 1]!);
  return 2 * Math.PI - gap;
}

/** The direction in which vectors have the least share: least eigenvector of Σ n nᵀ. */
function leastSpread(vectors: readonly Vector3[]): Vector3 {
  const sum = new Float64Array(9);
  for (const n of vectors)
    for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) sum[3 * i + j] = sum[3 * i + j]! + n[i]! * n[j]!;
  const [x, y, z] = symmetricEigen(sum).vectors[2]!;
  return [x!, y!, z!];
}

/** Meshes keep numbers of 32 bits: smaller components of an axis are rounding. */
const ROUNDING = 1e-7;

/** A direction and its opposite are one axis: the largest component is above 0. */
function positive(axis: Vector3): Vector3 {
  const largest = axis.reduce((most, value) => (Math.abs(value) > Math.abs(most) ? value : most), 0);
  const [x, y, z] = scale(axis, Math.sign(largest) / norm(axis)).map(value => (Math.abs(value) < ROUNDING ? 0 : value));
  return normalize([x!, y!, z!]);
}

/** Two unit vectors across an axis, at right angles. */
function acrossOf(axis: Vector3): readonly [Vector3, Vector3] {
  const least = axis.map(Math.abs).indexOf(Math.min(...axis.map(Math.abs)));
  const u = normalize(cross(axis, [least === 0 ? 1 : 0, least === 1 ? 1 : 0, least === 2 ? 1 : 0]));
  return [u, cross(axis, u)];
}

function cornersOf(topology: Topology, triangles: readonly number[]): Vector3[] {
  const vertices = new Set<number>();
  for (const t of triangles) for (let h = 3 * t; h < 3 * t + 3; h++) vertices.add(fromVertex(topology, h));
  return [...vertices].map(vertex => vertexPoint(topology, vertex));
}

interface FlatCircle {
  readonly x: number;
  readonly y: number;
  readonly radius_m: number;
}

/** The circle of least squares through points, as seen along u × v. Undefined for points of one line. */
function circleIn(points: readonly Vector3[], u: Vector3, v: Vector3): FlatCircle | undefined {
  // About their middle: the sums of fourth powers would lose what the circle is made of.
  const middle = scale(
    points.reduce((sum, point) => add(sum, point), [0, 0, 0] as Vector3),
    1 / points.length,
  );
  let xx = 0;
  let xy = 0;
  let yy = 0;
  let xr = 0;
  let yr = 0;
  let rr = 0;
  for (const point of points) {
    const from = subtract(point, middle);
    const x = dot(from, u);
    const y = dot(from, v);
    const squared = x * x + y * y;
    xx += x * x;
    xy += x * y;
    yy += y * y;
    xr += x * squared;
    yr += y * squared;
    rr += squared;
  }
  const determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-9 * rr * rr)) return undefined;
  const cx = (xr * yy - yr * xy) / (2 * determinant);
  const cy = (yr * xx - xr * xy) / (2 * determinant);
  return {
    x: cx + dot(middle, u),
    y: cy + dot(middle, v),
    radius_m: Math.sqrt(rr / points.length + cx * cx + cy * cy),
  };
}

/** The round edge nearest to a point. */
function circleNear({ chains }: FeatureEdges, point: Vector3, near_m: number): SurfaceFeature | undefined {
  let best: SurfaceFeature | undefined;
  let least = near_m;
  for (const { points } of chains) {
    if (points.length < LEAST_POINTS) continue;
    const away = Math.min(...points.map(corner => distance(corner, point)));
    if (away > least) continue;
    const circle = circleThrough(points);
    if (!circle) continue;
    best = circle;
    least = away;
  }
  return best;
}

function circleThrough(points: readonly Vector3[]): SurfaceFeature | undefined {
  const middle = scale(
    points.reduce((sum, point) => add(sum, point), [0, 0, 0] as Vector3),
    1 / points.length,
  );
  const axis = positive(leastSpread(points.map(point => subtract(point, middle))));
  const [u, v] = acrossOf(axis);
  const circle = circleIn(points, u, v);
  if (!circle) return undefined;
  const center_m = addScaled(add(scale(u, circle.x), scale(v, circle.y)), axis, dot(middle, axis));
  const tolerance = circle.radius_m * ROUND_SHARE;
  const spokes = points.map(point => subtract(point, center_m));
  const isRound = spokes.every(
    spoke => Math.abs(dot(spoke, axis)) <= tolerance && Math.abs(norm(spoke) - circle.radius_m) <= tolerance,
  );
  return isRound && turnOf(spokes, axis) >= LEAST_ARC_RAD
    ? { kind: "circle", center_m, axis, radius_m: circle.radius_m }
    : undefined;
}
