import { isClosed, isOriented } from "../mesh/measure.ts";
import { weldMesh } from "../mesh/weld.ts";
import { buildBvh } from "./bvh.ts";
import { keepsApart, surfaceDistance } from "./distance.ts";
import { surfacesTouch, type PairScratch } from "./intersect.ts";
import { pointInside, type Filling } from "./inside.ts";
import type { TriangleMesh } from "../mesh/mesh.ts";
import { movePoints, type Rigid } from "./relative.ts";

/** Files store the same corner more than once; corners nearer than this are the same [m]. */
const SAME_CORNER_M = 1e-7;

/** A mesh ready to be asked about contact and distance. Read only; may be shared by many places in the cell. */
export interface Solid extends Filling {
  /** One corner of every connected piece of surface, 3 numbers each [m]. */
  readonly shells: Float64Array;
  /** Radius of the smallest ball around the frame's origin that holds the solid [m]. */
  readonly radius_m: number;
}

export function buildSolid(mesh: TriangleMesh): Solid {
  const welded = weldMesh(mesh, SAME_CORNER_M).mesh;
  const p = mesh.positions;
  let radius2 = 0;
  for (const vertex of mesh.indices) {
    const x = p[3 * vertex]!;
    const y = p[3 * vertex + 1]!;
    const z = p[3 * vertex + 2]!;
    radius2 = Math.max(radius2, x * x + y * y + z * z);
  }
  return {
    bvh: buildBvh(mesh),
    closed: isClosed(welded),
    oriented: isOriented(welded),
    shells: shellCorners(welded),
    radius_m: Math.sqrt(radius2),
  };
}

/** Whether two solids share a point, one lying wholly inside the other included. The call allocates nothing. */
export function solidsTouch(a: Solid, b: Solid, aFromB: Rigid, scratch: PairScratch): boolean {
  return surfacesTouch(a.bvh, b.bvh, aFromB, scratch) || oneInsideOther(a, b, aFromB, scratch);
}

/**
 * Distance of two solids [m] when below `cutoff_m`, else Infinity; 0 when they share a point or one holds the other.
 * Parameters as in `surfaceDistance`.
 */
export function solidDistance(
  a: Solid,
  b: Solid,
  aFromB: Rigid,
  cutoff_m: number,
  scratch: PairScratch,
  out: Float64Array,
  enough_m = 0,
): number {
  const distance = surfaceDistance(a.bvh, b.bvh, aFromB, cutoff_m, scratch, out, enough_m);
  if (distance > 0 && oneInsideOther(a, b, aFromB, scratch)) {
    out.set(scratch.point, 0);
    out.set(scratch.point, 3);
    return 0;
  }
  return distance;
}

/** `keepsApart` for solids: what lies inside the other keeps no distance. */
export function solidKeepsApart(
  outer: Solid,
  inner: Solid,
  outerFromInner: Rigid,
  near_m: number,
  perMetre: number,
  scratch: PairScratch,
  out: Float64Array,
): boolean {
  return (
    keepsApart(outer.bvh, inner.bvh, outerFromInner, near_m, perMetre, scratch, out) &&
    !oneInsideOther(outer, inner, outerFromInner, scratch)
  );
}

/** Whether a piece of either surface lies inside the other solid; where, in a's frame, is left in `scratch.point`. */
function oneInsideOther(a: Solid, b: Solid, aFromB: Rigid, scratch: PairScratch): boolean {
  const point = scratch.point;
  for (let s = 0; s < b.shells.length; s += 3) {
    movePoints(aFromB, b.shells, s, 1, point, 0);
    if (pointInside(a, point[0]!, point[1]!, point[2]!, scratch)) return true;
  }
  const r = aFromB;
  for (let s = 0; s < a.shells.length; s += 3) {
    const x = a.shells[s]! - r[9]!;
    const y = a.shells[s + 1]! - r[10]!;
    const z = a.shells[s + 2]! - r[11]!;
    const bx = r[0]! * x + r[3]! * y + r[6]! * z;
    const by = r[1]! * x + r[4]! * y + r[7]! * z;
    const bz = r[2]! * x + r[5]! * y + r[8]! * z;
    if (!pointInside(b, bx, by, bz, scratch)) continue;
    for (let k = 0; k < 3; k++) point[k] = a.shells[s + k]!;
    return true;
  }
  return false;
}

/** The first corner of every connected piece of a welded mesh. */
function shellCorners(mesh: TriangleMesh): Float64Array {
  const { positions, indices } = mesh;
  const parent = new Int32Array(positions.length / 3);
  for (let v = 0; v < parent.length; v++) parent[v] = v;
  const root = (v: number): number => {
    while (parent[v] !== v) {
      parent[v] = parent[parent[v]!]!;
      v = parent[v]!;
    }
    return v;
  };
  for (let t = 0; t < indices.length; t += 3)
    for (let c = 1; c < 3; c++) {
      const a = root(indices[t]!);
      const b = root(indices[t + c]!);
      parent[Math.max(a, b)] = Math.min(a, b);
    }
  const corners: number[] = [];
  for (let v = 0; v < parent.length; v++)
    if (parent[v] === v) corners.push(positions[3 * v]!, positions[3 * v + 1]!, positions[3 * v + 2]!);
  return Float64Array.from(corners);
}
