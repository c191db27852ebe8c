import type { TriangleMesh } from "./mesh.ts";

/** A welded mesh and what welding did to it. */
export interface Welded {
  readonly mesh: TriangleMesh;
  /** Vertices that became one with an earlier one. */
  readonly merged: number;
  /** Triangles dropped because two of their corners became the same vertex or because their area is 0. */
  readonly dropped: number;
}

/**
 * Makes vertices within `tolerance_m` of an earlier one the same vertex and drops triangles that vanish with it.
 * Vertices are met in index order, so the answer does not depend on hashing; unused vertices disappear.
 *
 * @param tolerance_m  0 merges equal coordinates only.
 */
export function weldMesh(mesh: TriangleMesh, tolerance_m: number): Welded {
  const { positions, indices } = mesh;
  const count = positions.length / 3;
  const grid = new VertexGrid(count, tolerance_m, positions);
  const newOf = new Int32Array(count).fill(-1);
  const kept = new Float64Array(positions.length);
  const triangles = new Uint32Array(indices.length);
  let vertices = 0;
  let used = 0;
  let merged = 0;
  let dropped = 0;
  for (let t = 0; t < indices.length; t += 3) {
    for (let c = 0; c < 3; c++) {
      const old = indices[t + c]!;
      if (newOf[old] !== -1) continue;
      const x = positions[3 * old]!;
      const y = positions[3 * old + 1]!;
      const z = positions[3 * old + 2]!;
      const found = grid.find(kept, x, y, z);
      if (found >= 0) {
        newOf[old] = found;
        merged++;
        continue;
      }
      kept[3 * vertices] = x;
      kept[3 * vertices + 1] = y;
      kept[3 * vertices + 2] = z;
      grid.add(vertices, x, y, z);
      newOf[old] = vertices++;
    }
    const a = newOf[indices[t]!]!;
    const b = newOf[indices[t + 1]!]!;
    const c = newOf[indices[t + 2]!]!;
    if (a === b || b === c || c === a || hasNoArea(kept, a, b, c)) {
      dropped++;
      continue;
    }
    triangles[used] = a;
    triangles[used + 1] = b;
    triangles[used + 2] = c;
    used += 3;
  }
  return { mesh: { positions: kept.slice(0, 3 * vertices), indices: triangles.slice(0, used) }, merged, dropped };
}

function hasNoArea(p: Float64Array, a: number, b: number, c: number): boolean {
  const ux = p[3 * b]! - p[3 * a]!;
  const uy = p[3 * b + 1]! - p[3 * a + 1]!;
  const uz = p[3 * b + 2]! - p[3 * a + 2]!;
  const vx = p[3 * c]! - p[3 * a]!;
  const vy = p[3 * c + 1]! - p[3 * a + 1]!;
  const vz = p[3 * c + 2]! - p[3 * a + 2]!;
  return uy * vz - uz * vy === 0 && uz * vx - ux * vz === 0 && ux * vy - uy * vx === 0;
}

/** Vertices hashed by the cube they lie in; a cube is two tolerances wide, so at most eight are looked into. */
class VertexGrid {
  readonly #tolerance: number;
  readonly #cell: number;
  readonly #heads: Int32Array;
  readonly #next: Int32Array;

  constructor(count: number, tolerance: number, positions: Float64Array) {
    let largest = 0;
    for (const value of positions) largest = Math.max(largest, Math.abs(value));
    let slots = 16;
    while (slots < 2 * count) slots *= 2;
    this.#tolerance = tolerance;
    this.#cell = Math.max(2 * tolerance, largest * 1e-8, 1e-12);
    this.#heads = new Int32Array(slots).fill(-1);
    this.#next = new Int32Array(count).fill(-1);
  }

  #slot(i: number, j: number, k: number): number {
    const hash = Math.imul(i | 0, 73856093) ^ Math.imul(j | 0, 19349663) ^ Math.imul(k | 0, 83492791);
    return (hash ^ (hash >>> 15)) & (this.#heads.length - 1);
  }

  add(vertex: number, x: number, y: number, z: number): void {
    const slot = this.#slot(Math.floor(x / this.#cell), Math.floor(y / this.#cell), Math.floor(z / this.#cell));
    this.#next[vertex] = this.#heads[slot]!;
    this.#heads[slot] = vertex;
  }

  /** The vertex of lowest index within the tolerance, or −1. */
  find(kept: Float64Array, x: number, y: number, z: number): number {
    const r = this.#tolerance;
    const h = this.#cell;
    const r2 = r * r;
    const i1 = Math.floor((x + r) / h);
    const j1 = Math.floor((y + r) / h);
    const k1 = Math.floor((z + r) / h);
    let best = -1;
    for (let i = Math.floor((x - r) / h); i <= i1; i++)
      for (let j = Math.floor((y - r) / h); j <= j1; j++) {
        for (let k = Math.floor((z - r) / h); k <= k1; k++) {
          for (let v = this.#heads[this.#slot(i, j, k)]!; v >= 0; v = this.#next[v]!) {
            if (best >= 0 && v >= best) continue;
            const dx = kept[3 * v]! - x;
            const dy = kept[3 * v + 1]! - y;
            const dz = kept[3 * v + 2]! - z;
            if (dx * dx + dy * dy + dz * dz <= r2) best = v;
          }
        }
      }
    return best;
  }
}
