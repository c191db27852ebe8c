import type { TriangleMesh } from "./mesh.ts";
import type { Pose } from "../spatial/pose.ts";
import { transformPoint } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** The mesh seen in another frame: p_into = intoFromMesh · p. Indices are shared with the input. */
export function transformMesh(mesh: TriangleMesh, intoFromMesh: Pose): TriangleMesh {
  const positions = new Float64Array(mesh.positions.length);
  const point: Vector3 = [0, 0, 0];
  for (let i = 0; i < positions.length; i += 3) {
    point[0] = mesh.positions[i]!;
    point[1] = mesh.positions[i + 1]!;
    point[2] = mesh.positions[i + 2]!;
    positions.set(transformPoint(intoFromMesh, point, point), i);
  }
  return { positions, indices: mesh.indices };
}

/**
 * The mesh with every coordinate times `factor` (0.001 for a file in millimetres). Negative factors keep the winding
 * outward.
 */
export function scaleMesh(mesh: TriangleMesh, factor: number): TriangleMesh {
  const positions = mesh.positions.map(value => value * factor);
  if (factor >= 0) return { positions, indices: mesh.indices };
  const indices = mesh.indices.slice();
  for (let t = 0; t < indices.length; t += 3) {
    indices[t + 1] = mesh.indices[t + 2]!;
    indices[t + 2] = mesh.indices[t + 1]!;
  }
  return { positions, indices };
}

/** One solid and where it stands in the assembly; without a pose it stands at the origin. */
export interface Part {
  readonly mesh: TriangleMesh;
  readonly pose?: Pose;
}

/** All parts as one mesh, side by side: where parts overlap, their surfaces stay. */
export function mergeMeshes(parts: readonly Part[]): TriangleMesh {
  const placed = parts.map(({ mesh, pose }) => (pose ? transformMesh(mesh, pose) : mesh));
  const positions = new Float64Array(placed.reduce((sum, mesh) => sum + mesh.positions.length, 0));
  const indices = new Uint32Array(placed.reduce((sum, mesh) => sum + mesh.indices.length, 0));
  let vertex = 0;
  let corner = 0;
  for (const mesh of placed) {
    positions.set(mesh.positions, 3 * vertex);
    for (const index of mesh.indices) indices[corner++] = index + vertex;
    vertex += mesh.positions.length / 3;
  }
  return { positions, indices };
}
