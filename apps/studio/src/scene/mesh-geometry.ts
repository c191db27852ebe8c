import type { TriangleMesh } from "@twincell/core";
import { BufferAttribute, BufferGeometry } from "three";

/** Faces that meet at less than this are shaded as one surface [rad]. */
const CREASE_RAD = 0.72;
const GRAIN_M = 1e-6;

/**
 * A drawable geometry: shaded smooth up to the crease angle. Normals are weighted by area, so that large flat faces
 * stay flat and only the bevels beside them bend.
 */
export function meshGeometry(mesh: TriangleMesh): BufferGeometry {
  const corners = mesh.indices.length;
  const { positions, indices } = mesh;
  const adapters = new Float32Array(corners); // area-weighted normal per triangle
  const at = new Map<string, number[]>();
  const keys: string[] = Array.from(
    { length: positions.length / 3 },
    (_, v) =>
      `${Math.round(positions[3 * v]! / GRAIN_M)} ${Math.round(positions[3 * v + 1]! / GRAIN_M)} ${Math.round(positions[3 * v + 2]! / GRAIN_M)}`,
  );
  for (let t = 0; t < corners; t += 3) {
    const a = 3 * indices[t]!;
    const b = 3 * indices[t + 1]!;
    const c = 3 * indices[t + 2]!;
    const ux = positions[b]! - positions[a]!;
    const uy = positions[b + 1]! - positions[a + 1]!;
    const uz = positions[b + 2]! - positions[a + 2]!;
    const vx = positions[c]! - positions[a]!;
    const vy = positions[c + 1]! - positions[a + 1]!;
    const vz = positions[c + 2]! - positions[a + 2]!;
    adapters[t] = uy * vz - uz * vy;
    adapters[t + 1] = uz * vx - ux * vz;
    adapters[t + 2] = ux * vy - uy * vx;
    for (let k = 0; k < 3; k++) {
      const key = keys[indices[t + k]!]!;
      const list = at.get(key);
      if (list) list.push(t);
      else at.set(key, [t]);
    }
  }
  const drawn = new Float32Array(3 * corners);
  const normals = new Float32Array(3 * corners);
  const cosine = Math.cos(CREASE_RAD);
  for (let i = 0; i < corners; i++) {
    const t = i - (i % 3);
    const v = indices[i]!;
    const size = Math.hypot(adapters[t]!, adapters[t + 1]!, adapters[t + 2]!) || 1;
    let nx = 0;
    let ny = 0;
    let nz = 0;
    for (const other of at.get(keys[v]!)!) {
      const ox = adapters[other]!;
      const oy = adapters[other + 1]!;
      const oz = adapters[other + 2]!;
      const otherSize = Math.hypot(ox, oy, oz);
      if (ox * adapters[t]! + oy * adapters[t + 1]! + oz * adapters[t + 2]! >= cosine * size * otherSize) {
        nx += ox;
        ny += oy;
        nz += oz;
      }
    }
    const n = Math.hypot(nx, ny, nz) || 1;
    for (let k = 0; k < 3; k++) drawn[3 * i + k] = positions[3 * v + k]!;
    normals[3 * i] = nx / n;
    normals[3 * i + 1] = ny / n;
    normals[3 * i + 2] = nz / n;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(drawn, 3));
  geometry.setAttribute("normal", new BufferAttribute(normals, 3));
  return geometry;
}
