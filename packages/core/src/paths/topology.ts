import type { TriangleMesh } from "../mesh/mesh.ts";

/**
 * Who borders on whom in a welded mesh. Half-edge 3 t + k runs from corner k of triangle t to its next corner with the
 * triangle on its left, seen from outside.
 */
export interface Topology {
  readonly mesh: TriangleMesh;
  /** The half-edge on the other side, or −1 at an open border and where more than two triangles meet. */
  readonly twins: Int32Array;
  /** Unit normals of the triangles, 3 numbers each. */
  readonly normals: Float64Array;
  /** Edges with one triangle, and edges with more than two or with neighbours of opposite winding. */
  readonly open: number;
  readonly crowded: number;
}

export function topologyOf(mesh: TriangleMesh): Topology {
  const { positions, indices } = mesh;
  const vertices = positions.length / 3;
  const twins = new Int32Array(indices.length).fill(-1);
  const met = new Map<number, number[]>();
  for (let h = 0; h < indices.length; h++) {
    const a = indices[h]!;
    const b = indices[nextInTriangle(h)]!;
    const key = Math.min(a, b) * vertices + Math.max(a, b);
    const others = met.get(key);
    if (others) others.push(h);
    else met.set(key, [h]);
  }
  let open = 0;
  let crowded = 0;
  for (const halves of met.values()) {
    if (halves.length === 1) {
      open++;
      continue;
    }
    const [g, h] = [halves[0]!, halves[1]!];
    if (halves.length > 2 || indices[g] === indices[h]) {
      crowded++;
      continue;
    }
    twins[g] = h;
    twins[h] = g;
  }
  return { mesh, twins, normals: normalsOf(mesh), open, crowded };
}

export const nextInTriangle = (h: number): number => (h % 3 === 2 ? h - 2 : h + 1);
export const triangleOf = (h: number): number => Math.floor(h / 3);
export const fromVertex = (topology: Topology, h: number): number => topology.mesh.indices[h]!;
export const toVertex = (topology: Topology, h: number): number => topology.mesh.indices[nextInTriangle(h)]!;

function normalsOf({ positions: p, indices }: TriangleMesh): Float64Array {
  const normals = new Float64Array(indices.length);
  for (let t = 0; t < indices.length; t += 3) {
    const a = 3 * indices[t]!;
    const b = 3 * indices[t + 1]!;
    const c = 3 * indices[t + 2]!;
    const ux = p[b]! - p[a]!;
    const uy = p[b + 1]! - p[a + 1]!;
    const uz = p[b + 2]! - p[a + 2]!;
    const vx = p[c]! - p[a]!;
    const vy = p[c + 1]! - p[a + 1]!;
    const vz = p[c + 2]! - p[a + 2]!;
    const x = uy * vz - uz * vy;
    const y = uz * vx - ux * vz;
    const z = ux * vy - uy * vx;
    const length = Math.sqrt(x * x + y * y + z * z);
    if (length === 0) continue;
    // + 0 turns −0 into 0: normals are compared and printed.
    normals[t] = x / length + 0;
    normals[t + 1] = y / length + 0;
    normals[t + 2] = z / length + 0;
  }
  return normals;
}
