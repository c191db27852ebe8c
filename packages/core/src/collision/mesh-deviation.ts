import type { TriangleMesh } from "../mesh/mesh.ts";
import { tetrahedronMesh } from "../mesh/solids.ts";
import { surfaceDistance } from "./distance.ts";
import { pointInside } from "./inside.ts";
import { pairScratch } from "./intersect.ts";
import { rigid } from "./relative.ts";
import { buildSolid, type Solid } from "./solid.ts";
import type { Random } from "../random.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** How far two surfaces stand outside of one another [m]. */
export interface ShapeDeviation {
  /** Farthest point of the true surface outside of the drawn solids. */
  readonly trueOutsideDrawn_m: number;
  /** Farthest point of the drawn surface outside of the true one. */
  readonly drawnOutsideTrue_m: number;
}

/** Half the size of a point that distances are measured from: far below what is measured. */
const POINT_M = 1e-7;

/**
 * Two-sided distance of a drawn link from the true one, at points spread evenly over both surfaces. What lies inside
 * the other counts 0; of the drawn solids, which may overlap, only the outside is looked at.
 *
 * @param drawn    closed solids that together are the link.
 * @param truth    surface of the link; may have holes.
 * @param samples  points on either side.
 */
export function shapeDeviation(
  drawn: readonly TriangleMesh[],
  truth: TriangleMesh,
  samples: number,
  random: Random,
): ShapeDeviation {
  const solids = drawn.map(buildSolid);
  const real = buildSolid(truth);
  const meter = new Meter();
  let trueOutsideDrawn_m = 0;
  let drawnOutsideTrue_m = 0;
  for (const at of pointsOn([truth], samples, random)) {
    if (solids.some(solid => meter.inside(solid, at.point))) continue;
    trueOutsideDrawn_m = Math.max(
      trueOutsideDrawn_m,
      Math.min(...solids.map(solid => meter.distance(solid, at.point))),
    );
  }
  for (const at of pointsOn(drawn, samples, random)) {
    if (solids.some((solid, i) => i !== at.mesh && meter.inside(solid, at.point)) || meter.inside(real, at.point))
      continue;
    const distance_m = meter.distance(real, at.point);
    // Parts that overlap, as drawings have them, look like holes to a ray; counting turns is slow and asked last.
    if (distance_m > drawnOutsideTrue_m && Math.abs(turnsAround(truth, at.point)) < OPEN_TURNS)
      drawnOutsideTrue_m = distance_m;
  }
  return { trueOutsideDrawn_m, drawnOutsideTrue_m };
}

/**
 * Meshes of hollow castings are open where the next link sits in them: in the plane of such an opening half a turn is
 * seen.
 */
const OPEN_TURNS = 0.25;

class Meter {
  readonly #scratch = pairScratch();
  readonly #points = new Float64Array(6);
  readonly #at = rigid();
  readonly #point = buildSolid(tetrahedronMesh(POINT_M));

  inside(solid: Solid, [x, y, z]: Vector3): boolean {
    return pointInside(solid, x, y, z, this.#scratch);
  }

  distance({ bvh }: Solid, [x, y, z]: Vector3): number {
    this.#at[9] = x;
    this.#at[10] = y;
    this.#at[11] = z;
    this.#scratch.witness.fill(-1);
    return surfaceDistance(bvh, this.#point.bvh, this.#at, Infinity, this.#scratch, this.#points);
  }
}

/**
 * How often a surface winds around a point: the solid angle of all its triangles over 4π (Van Oosterom, Strackee 1983).
 */
function turnsAround({ positions: p, indices }: TriangleMesh, [x, y, z]: Vector3): number {
  let sum = 0;
  for (let t = 0; t < indices.length; t += 3) {
    const a = 3 * indices[t]!;
    const b = 3 * indices[t + 1]!;
    const c = 3 * indices[t + 2]!;
    const ax = p[a]! - x;
    const ay = p[a + 1]! - y;
    const az = p[a + 2]! - z;
    const bx = p[b]! - x;
    const by = p[b + 1]! - y;
    const bz = p[b + 2]! - z;
    const cx = p[c]! - x;
    const cy = p[c + 1]! - y;
    const cz = p[c + 2]! - z;
    const la = Math.hypot(ax, ay, az);
    const lb = Math.hypot(bx, by, bz);
    const lc = Math.hypot(cx, cy, cz);
    const volume = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    sum +=
      2 *
      Math.atan2(
        volume,
        la * lb * lc +
          (ax * bx + ay * by + az * bz) * lc +
          (bx * cx + by * cy + bz * cz) * la +
          (cx * ax + cy * ay + cz * az) * lb,
      );
  }
  return sum / (4 * Math.PI);
}

/** Points spread over the triangles of all meshes by area, a random one in each equal share. */
function* pointsOn(
  meshes: readonly TriangleMesh[],
  count: number,
  random: Random,
): Generator<{ readonly mesh: number; readonly point: Vector3 }> {
  const areas = meshes.map(areasOf);
  const total = areas.reduce((sum, each) => sum + each.reduce((a, b) => a + b, 0), 0);
  let passed = 0;
  let drawn = 0;
  for (let mesh = 0; mesh < meshes.length; mesh++) {
    const { positions: p, indices } = meshes[mesh]!;
    for (let t = 0; t < indices.length / 3; t++) {
      passed += areas[mesh]![t]!;
      for (; drawn < (passed / total) * count; drawn++) {
        let u = random();
        let v = random();
        if (u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        const [a, b, c] = [0, 1, 2].map(k => 3 * indices[3 * t + k]!) as [number, number, number];
        const at = (k: number): number => p[a + k]! + u * (p[b + k]! - p[a + k]!) + v * (p[c + k]! - p[a + k]!);
        yield { mesh, point: [at(0), at(1), at(2)] };
      }
    }
  }
}

function areasOf({ positions: p, indices }: TriangleMesh): Float64Array {
  return Float64Array.from({ length: indices.length / 3 }, (_, t) => {
    const [a, b, c] = [0, 1, 2].map(k => 3 * indices[3 * t + k]!) as [number, number, number];
    const ux = p[b]! - p[a]!;
    const uy = p[b + 1]! - p[a + 1]!;
    const uz = p[b + 2]! - p[a + 2]!;
    const vx = p[c]! - p[a]!;
    const vy = p[c + 1]! - p[a + 1]!;
    const vz = p[c + 2]! - p[a + 2]!;
    return Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
  });
}
