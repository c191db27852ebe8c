import {
  buildBvh,
  pairScratch,
  rigid,
  surfaceDistance,
  type Bvh,
  type Random,
  type TriangleMesh,
} from "@twincell/core";

/** How far two surfaces are apart, looked at from both [m]. */
export interface SurfaceDeviation {
  /** Largest distance of a sample to the other surface. Between the samples it may be larger. */
  readonly max_m: number;
  /** Root of the mean square of all samples' distances. */
  readonly rms_m: number;
  readonly samples: number;
}

/** Half the size of the tiny tetrahedron that a point is measured with [m]. */
const POINT_M = 1e-9;

/**
 * Distances between two surfaces at samples of both: half of them corners, half spread over the triangles by area.
 *
 * @param samples  on either side.
 */
export function surfaceDeviation(a: TriangleMesh, b: TriangleMesh, samples: number, random: Random): SurfaceDeviation {
  const meter = new PointMeter();
  const there = oneSide(a, buildBvh(b), samples, random, meter);
  const back = oneSide(b, buildBvh(a), samples, random, meter);
  const count = there.count + back.count;
  return {
    max_m: Math.max(there.max, back.max),
    rms_m: count === 0 ? 0 : Math.sqrt((there.squares + back.squares) / count),
    samples: count,
  };
}

interface Side {
  max: number;
  squares: number;
  count: number;
}

function oneSide(
  { positions: p, indices }: TriangleMesh,
  other: Bvh,
  samples: number,
  random: Random,
  meter: PointMeter,
): Side {
  const side: Side = { max: 0, squares: 0, count: 0 };
  const take = (x: number, y: number, z: number): void => {
    const distance = meter.distance(other, x, y, z);
    side.max = Math.max(side.max, distance);
    side.squares += distance * distance;
    side.count++;
  };
  const triangles = indices.length / 3;
  const sums = new Float64Array(triangles);
  let total = 0;
  for (let t = 0; t < triangles; t++) sums[t] = total += areaOf(p, indices, 3 * t);
  for (let i = 0; i < samples / 2; i++) {
    const corner = 3 * indices[Math.floor(random() * indices.length)]!;
    take(p[corner]!, p[corner + 1]!, p[corner + 2]!);
    const t = firstAbove(sums, random() * total);
    let u = random();
    let v = random();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const [ia, ib, ic] = [3 * indices[3 * t]!, 3 * indices[3 * t + 1]!, 3 * indices[3 * t + 2]!];
    const at = (k: number): number => p[ia + k]! + u * (p[ib + k]! - p[ia + k]!) + v * (p[ic + k]! - p[ia + k]!);
    take(at(0), at(1), at(2));
  }
  return side;
}

function firstAbove(sums: Float64Array, value: number): number {
  let low = 0;
  let high = sums.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sums[middle]! < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

function areaOf(p: Float64Array, indices: Uint32Array, at: number): number {
  const [a, b, c] = [3 * indices[at]!, 3 * indices[at + 1]!, 3 * indices[at + 2]!];
  const [ux, uy, uz] = [p[b]! - p[a]!, p[b + 1]! - p[a + 1]!, p[b + 2]! - p[a + 2]!];
  const [vx, vy, vz] = [p[c]! - p[a]!, p[c + 1]! - p[a + 1]!, p[c + 2]! - p[a + 2]!];
  return Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
}

class PointMeter {
  readonly #scratch = pairScratch();
  readonly #points = new Float64Array(6);
  readonly #at = rigid();
  // biome-ignore format: corners of a tetrahedron
  readonly #point = buildBvh({
    positions: Float64Array.of(
      POINT_M, POINT_M, POINT_M,  -POINT_M, -POINT_M, POINT_M,
      -POINT_M, POINT_M, -POINT_M,  POINT_M, -POINT_M, -POINT_M,
    ),
    indices: Uint32Array.of(0, 1, 3, 0, 2, 1, 0, 3, 2, 1, 2, 3),
  });
  distance(bvh: Bvh, x: number, y: number, z: number): number {
    this.#at[9] = x;
    this.#at[10] = y;
    this.#at[11] = z;
    this.#scratch.witness.fill(-1);
    return surfaceDistance(bvh, this.#point, this.#at, Infinity, this.#scratch, this.#points);
  }
}
