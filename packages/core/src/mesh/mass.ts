import type { TriangleMesh } from "./mesh.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** A solid of density 1: what it weighs and how it turns. */
export interface MassProperties {
  readonly volume_m3: number;
  readonly center_m: Vector3;
  /** About the centre, axes of the mesh, per unit of density: Ixx, Iyy, Izz, Ixy, Ixz, Iyz [m⁵]. */
  readonly inertia_m5: readonly [number, number, number, number, number, number];
}

/**
 * Volume, centre and inertia of a closed mesh, summed over the tetrahedra between the origin and its triangles (a, b,
 * c):
 *
 *   V = Σ d / 6,   c = Σ d (a + b + c) / 24 V,   ∫ x_i x_j = Σ d / 120 ( Σ p_i Σ p_j + Σ p_i p_j ),   d = a · (b × c)
 *
 * Products of inertia carry the sign of the matrix:  Ixy = −∫ x y.
 */
export function massProperties({ positions: p, indices }: TriangleMesh): MassProperties {
  let volume = 0;
  const first = [0, 0, 0];
  const second = new Float64Array(9);
  for (let t = 0; t < indices.length; t += 3) {
    const a = 3 * indices[t]!;
    const b = 3 * indices[t + 1]!;
    const c = 3 * indices[t + 2]!;
    const d =
      p[a]! * (p[b + 1]! * p[c + 2]! - p[b + 2]! * p[c + 1]!) +
      p[a + 1]! * (p[b + 2]! * p[c]! - p[b]! * p[c + 2]!) +
      p[a + 2]! * (p[b]! * p[c + 1]! - p[b + 1]! * p[c]!);
    volume += d / 6;
    for (let i = 0; i < 3; i++) {
      const si = p[a + i]! + p[b + i]! + p[c + i]!;
      first[i]! += (d / 24) * si;
      for (let j = i; j < 3; j++) {
        const sj = p[a + j]! + p[b + j]! + p[c + j]!;
        second[3 * i + j]! +=
          (d / 120) * (si * sj + p[a + i]! * p[a + j]! + p[b + i]! * p[b + j]! + p[c + i]! * p[c + j]!);
      }
    }
  }
  const center_m: Vector3 = volume > 0 ? [first[0]! / volume, first[1]! / volume, first[2]! / volume] : [0, 0, 0];
  const [x, y, z] = center_m;
  const xx = second[0]! - volume * x * x;
  const yy = second[4]! - volume * y * y;
  const zz = second[8]! - volume * z * z;
  return {
    volume_m3: volume,
    center_m,
    inertia_m5: [
      yy + zz,
      xx + zz,
      xx + yy,
      volume * x * y - second[1]!,
      volume * x * z - second[2]!,
      volume * y * z - second[5]!,
    ],
  };
}
