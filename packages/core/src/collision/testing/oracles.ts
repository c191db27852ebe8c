import {
  fromAxisAngle,
  normalize,
  pose,
  transformPoint,
  type Pose,
  type Random,
  type TriangleMesh,
  type Vector3,
} from "../../index.ts";

/** Slow answers by other means than the code under test. */

export type Triangle = readonly [Vector3, Vector3, Vector3];

export function trianglesOf(mesh: TriangleMesh, into: Pose = pose()): Triangle[] {
  const corner = (i: number): Vector3 => {
    const v = 3 * mesh.indices[i]!;
    return transformPoint(into, [mesh.positions[v]!, mesh.positions[v + 1]!, mesh.positions[v + 2]!]);
  };
  return Array.from({ length: mesh.indices.length / 3 }, (_, t) => [
    corner(3 * t),
    corner(3 * t + 1),
    corner(3 * t + 2),
  ]);
}

const minus = (a: Vector3, b: Vector3): Vector3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dotOf = (a: Vector3, b: Vector3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const crossOf = (a: Vector3, b: Vector3): Vector3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** Möller–Trumbore: whether the segment goes through the triangle. */
function pierces(from: Vector3, to: Vector3, [a, b, c]: Triangle): boolean {
  const d = minus(to, from);
  const e = minus(b, a);
  const f = minus(c, a);
  const p = crossOf(d, f);
  const det = dotOf(e, p);
  if (det === 0) return false;
  const s = minus(from, a);
  const u = dotOf(s, p) / det;
  const q = crossOf(s, e);
  const v = dotOf(d, q) / det;
  const t = dotOf(f, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1;
}

/** Two triangles in general position meet exactly when an edge of one goes through the other. */
export const meetInGeneral = (p: Triangle, q: Triangle): boolean =>
  [0, 1, 2].some(i => pierces(p[i]!, p[(i + 1) % 3]!, q) || pierces(q[i]!, q[(i + 1) % 3]!, p));

/** Closest point of a triangle by the regions around it (Ericson 5.1.5). */
export function closestOn(point: Vector3, [a, b, c]: Triangle): Vector3 {
  const along = (from: Vector3, to: Vector3, t: number): Vector3 => [
    from[0] + t * (to[0] - from[0]),
    from[1] + t * (to[1] - from[1]),
    from[2] + t * (to[2] - from[2]),
  ];
  const ab = minus(b, a);
  const ac = minus(c, a);
  const ap = minus(point, a);
  const bp = minus(point, b);
  const cp = minus(point, c);
  const d1 = dotOf(ab, ap);
  const d2 = dotOf(ac, ap);
  const d3 = dotOf(ab, bp);
  const d4 = dotOf(ac, bp);
  const d5 = dotOf(ab, cp);
  const d6 = dotOf(ac, cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const vc = d1 * d4 - d3 * d2;
  const vb = d5 * d2 - d1 * d6;
  const va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return along(a, b, d1 / (d1 - d3));
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return along(a, c, d2 / (d2 - d6));
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return along(b, c, (d4 - d3) / (d4 - d3 + d5 - d6));
  const sum = va + vb + vc;
  return [0, 1, 2].map(k => a[k]! + (ab[k]! * vb) / sum + (ac[k]! * vc) / sum) as Vector3;
}

/** Distance of two triangles by projecting to and fro: it falls to the least distance of two convex sets. */
export function distanceByProjection(p: Triangle, q: Triangle, rounds = 4000): number {
  let x = p[0];
  let y = closestOn(x, q);
  for (let i = 0; i < rounds; i++) {
    x = closestOn(y, p);
    y = closestOn(x, q);
  }
  return Math.hypot(...minus(x, y));
}

export function randomPose(random: Random, reach_m: number): Pose {
  const between = (): number => 2 * random() - 1;
  return pose(
    [between() * reach_m, between() * reach_m, between() * reach_m],
    fromAxisAngle(normalize([between(), between(), between()]), Math.PI * between()),
  );
}

/** Loose random triangles in a unit cube, some of them slivers. */
export function randomMesh(random: Random, triangles: number): TriangleMesh {
  const positions = new Float64Array(9 * triangles);
  for (let t = 0; t < triangles; t++) {
    const middle = [random(), random(), random()];
    const reach = random() < 0.2 ? 0.6 : 0.15;
    const thin = random() < 0.2 ? 1e-3 : 1;
    for (let c = 0; c < 3; c++)
      for (let k = 0; k < 3; k++)
        positions[9 * t + 3 * c + k] = middle[k]! - 0.5 + (random() - 0.5) * reach * (k === 0 ? thin : 1);
  }
  return { positions, indices: Uint32Array.from({ length: 3 * triangles }, (_, i) => i) };
}
