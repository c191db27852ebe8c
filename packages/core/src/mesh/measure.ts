import type { TriangleMesh } from "./mesh.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** Axis-aligned box. Empty when a lower corner is above its upper one. */
export interface Bounds {
  readonly lower: Vector3;
  readonly upper: Vector3;
}

/** The smallest axis-aligned box around all vertices that a triangle uses. */
export function meshBounds(mesh: TriangleMesh): Bounds {
  const lower: Vector3 = [Infinity, Infinity, Infinity];
  const upper: Vector3 = [-Infinity, -Infinity, -Infinity];
  for (const vertex of mesh.indices)
    for (let k = 0; k < 3; k++) {
      const value = mesh.positions[3 * vertex + k]!;
      if (value < lower[k]!) lower[k] = value;
      if (value > upper[k]!) upper[k] = value;
    }
  return { lower, upper };
}

/** V = Σ a · (b × c) / 6 [m³]: positive when the winding of a closed mesh is outward. */
export function meshVolume(mesh: TriangleMesh): number {
  const p = mesh.positions;
  const index = mesh.indices;
  let six = 0;
  for (let t = 0; t < index.length; t += 3) {
    const a = 3 * index[t]!;
    const b = 3 * index[t + 1]!;
    const c = 3 * index[t + 2]!;
    six +=
      p[a]! * (p[b + 1]! * p[c + 2]! - p[b + 2]! * p[c + 1]!) +
      p[a + 1]! * (p[b + 2]! * p[c]! - p[b]! * p[c + 2]!) +
      p[a + 2]! * (p[b]! * p[c + 1]! - p[b + 1]! * p[c]!);
  }
  return six / 6;
}

/**
 * Edges that do not have exactly one triangle on either side. 0 on both counts: the mesh is closed and its winding
 * agrees.
 */
export interface EdgeCensus {
  readonly open: number;
  readonly crowded: number;
}

/**
 * Counts edges with one triangle (open) and with more than two, or two of the same winding (crowded). Vertices must be
 * welded.
 */
export function censusOfEdges(mesh: TriangleMesh): EdgeCensus {
  const index = mesh.indices;
  const vertices = mesh.positions.length / 3;
  const uses = new Map<number, number>();
  for (let t = 0; t < index.length; t += 3)
    for (let c = 0; c < 3; c++) {
      const key = index[t + c]! * vertices + index[t + ((c + 1) % 3)]!;
      uses.set(key, (uses.get(key) ?? 0) + 1);
    }
  let open = 0;
  let crowded = 0;
  for (const [key, times] of uses) {
    const from = Math.floor(key / vertices);
    const to = key % vertices;
    const back = uses.get(to * vertices + from) ?? 0;
    if (times > 1) crowded++;
    else if (back === 0) open++;
  }
  return { open, crowded };
}

export function isClosed(mesh: TriangleMesh): boolean {
  const { open, crowded } = censusOfEdges(mesh);
  return mesh.indices.length > 0 && open === 0 && crowded === 0;
}

/**
 * Whether triangles that share an edge agree on which side is out: along every edge as many run one way as the other,
 * but for one at an open border. Vertices must be welded.
 */
export function isOriented({ indices, positions }: TriangleMesh): boolean {
  const vertices = positions.length / 3;
  const balance = new Map<number, number>();
  for (let t = 0; t < indices.length; t += 3)
    for (let c = 0; c < 3; c++) {
      const from = indices[t + c]!;
      const to = indices[t + ((c + 1) % 3)]!;
      const key = Math.min(from, to) * vertices + Math.max(from, to);
      balance.set(key, (balance.get(key) ?? 0) + (from < to ? 1 : -1));
    }
  for (const surplus of balance.values()) if (Math.abs(surplus) > 1) return false;
  return true;
}
