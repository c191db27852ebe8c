import type { TriangleMesh } from "./mesh.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { meshVolume } from "./measure.ts";
import { doubleArea, triangulate, type Point2 } from "./polygon.ts";

/** Every solid here is closed, welded and wound outward (right hand, thumb away from the material). */

/** A box around the origin with edges of the given lengths [m]. */
export function boxMesh(size_m: Vector3): TriangleMesh {
  const [x, y, z] = [size_m[0] / 2, size_m[1] / 2, size_m[2] / 2];
  return extrudedMesh(
    [
      [-x, -y],
      [x, -y],
      [x, y],
      [-x, y],
    ],
    -z,
    z,
  );
}

/** A cylinder along z, its middle in the origin. */
export function cylinderMesh(radius_m: number, height_m: number, segments = 32): TriangleMesh {
  return revolvedMesh(
    [
      [radius_m, -height_m / 2],
      [radius_m, height_m / 2],
    ],
    segments,
  );
}

/** A ball around the origin, poles on z. */
export function sphereMesh(radius_m: number, segments = 32, rings = 16): TriangleMesh {
  const profile: Point2[] = [];
  for (let i = 0; i <= rings; i++) {
    const a = (Math.PI * i) / rings;
    profile.push([i === 0 || i === rings ? 0 : radius_m * Math.sin(a), -radius_m * Math.cos(a)]);
  }
  return revolvedMesh(profile, segments);
}

/** A torus about z around the origin: `radius_m` to the middle of the tube. */
export function torusMesh(radius_m: number, tube_m: number, segments = 64, tubeSegments = 24): TriangleMesh {
  const profile: Point2[] = [];
  for (let i = 0; i < tubeSegments; i++) {
    const a = (2 * Math.PI * i) / tubeSegments;
    profile.push([radius_m + tube_m * Math.cos(a), tube_m * Math.sin(a)]);
  }
  return revolvedMesh(profile, segments, { ring: true });
}

/**
 * The solid swept by an outline turned once about z.
 *
 * @param profile  (radius, z) pairs [m], radius ≥ 0. Either an open line, whose ends are closed with flat discs where
 *                 they are off the axis, or with `ring` a closed outline that stays off the axis.
 * @param segments  flat faces per turn, at least 3. Vertices lie on the true surface, faces inside it.
 */
export function revolvedMesh(profile: readonly Point2[], segments = 32, { ring = false } = {}): TriangleMesh {
  const rows: Point2[] = [...profile];
  if (!ring && rows[0]![0] > 0) rows.unshift([0, rows[0]![1]]);
  if (!ring && rows.at(-1)![0] > 0) rows.push([0, rows.at(-1)![1]]);
  const positions: number[] = [];
  const starts: number[] = [];
  for (const [r, z] of rows) {
    starts.push(positions.length / 3);
    if (r === 0) {
      positions.push(0, 0, z);
      continue;
    }
    for (let s = 0; s < segments; s++) {
      const a = (2 * Math.PI * s) / segments;
      positions.push(r * Math.cos(a), r * Math.sin(a), z);
    }
  }
  const vertex = (row: number, s: number): number => starts[row]! + (rows[row]![0] === 0 ? 0 : s % segments);
  const indices: number[] = [];
  for (let row = 0; row < rows.length - (ring ? 0 : 1); row++) {
    const up = (row + 1) % rows.length;
    for (let s = 0; s < segments; s++) {
      if (rows[row]![0] > 0) indices.push(vertex(row, s), vertex(row, s + 1), vertex(up, s));
      if (rows[up]![0] > 0) indices.push(vertex(row, s + 1), vertex(up, s + 1), vertex(up, s));
    }
  }
  return outward({ positions: Float64Array.from(positions), indices: Uint32Array.from(indices) });
}

/** The prism between two heights over a simple outline (x, y) [m], concave ones included. */
export function extrudedMesh(outline: readonly Point2[], from_m: number, to_m: number): TriangleMesh {
  const n = outline.length;
  const positions: number[] = [];
  const indices: number[] = [];
  for (const z of [from_m, to_m]) for (const [x, y] of outline) positions.push(x, y, z);
  const top = triangulate(outline);
  for (let t = 0; t < top.length; t += 3) {
    indices.push(top[t]! + n, top[t + 1]! + n, top[t + 2]! + n, top[t]!, top[t + 2]!, top[t + 1]!);
  }
  const clockwise = doubleArea(outline) < 0;
  for (let i = 0; i < n; i++) {
    const a = clockwise ? (i + 1) % n : i;
    const b = clockwise ? i : (i + 1) % n;
    indices.push(a, b, b + n, a, b + n, a + n);
  }
  return outward({ positions: Float64Array.from(positions), indices: Uint32Array.from(indices) });
}

/** The same solid with its winding turned over when its volume came out negative. */
function outward(mesh: TriangleMesh): TriangleMesh {
  if (meshVolume(mesh) >= 0) return mesh;
  const indices = mesh.indices.slice();
  for (let t = 0; t < indices.length; t += 3) {
    const b = indices[t + 1]!;
    indices[t + 1] = indices[t + 2]!;
    indices[t + 2] = b;
  }
  return { positions: mesh.positions, indices };
}

/** A regular tetrahedron about the origin, its corners on a cube of this half side [m]: the least closed mesh. */
export const tetrahedronMesh = (half_m: number): TriangleMesh => ({
  // biome-ignore format: a corner a line
  positions: Float64Array.of(
    half_m, half_m, half_m,
    -half_m, -half_m, half_m,
    -half_m, half_m, -half_m,
    half_m, -half_m, -half_m,
  ),
  indices: Uint32Array.of(0, 1, 3, 0, 2, 1, 0, 3, 2, 1, 2, 3),
});
