import type { Bvh } from "./bvh.ts";
import type { PairScratch } from "./intersect.ts";

/** How a surface is filled, as far as its edges tell: see `pointInside`. */
export interface Filling {
  readonly bvh: Bvh;
  /** Every edge has one triangle on either side, and they agree on which side is out. */
  readonly closed: boolean;
  /** The same as far as there are two: open borders may be left, and coinciding edges of several parts. */
  readonly oriented: boolean;
}

/**
 * Whether a point lies inside the surface. Where the surface knows its outside, the winding number decides: ways out
 * minus ways in along a ray, not 0 inside. So a point where two parts of one mesh overlap is inside both (the number of
 * crossings there is even), and a hollow whose wall faces it is outside. Without agreement on the outside, an odd
 * number of crossings is inside. In a shell with open borders one ray may slip out, so six rays vote there and four
 * must agree.
 *
 * The rays run along the axes, and an edge is crossed by the half-open rule in the plane across the ray, computed the
 * same way for both of its triangles: a ray through an edge or a corner counts once, never twice and never not at all.
 */
export function pointInside(
  { bvh, closed, oriented }: Filling,
  x: number,
  y: number,
  z: number,
  scratch: PairScratch,
): boolean {
  const box = bvh.boxes;
  if (Math.abs(x - box[0]!) > box[3]! || Math.abs(y - box[1]!) > box[4]! || Math.abs(z - box[2]!) > box[5]!)
    return false;
  if (closed) return isIn(crossings(bvh, oriented, 0, x, y, z, 1, scratch), oriented);
  let votes = 0;
  for (let axis = 0; axis < 3; axis++)
    for (const way of BOTH_WAYS) if (isIn(crossings(bvh, oriented, axis, x, y, z, way, scratch), oriented)) votes++;
  return votes >= 4;
}

const BOTH_WAYS = [1, -1] as const;
const isIn = (count: number, signed: boolean): boolean => (signed ? count !== 0 : (count & 1) === 1);

/**
 * How often the ray from the point along `way` times the axis crosses the surface; `signed`, how often out minus how
 * often in.
 */
function crossings(
  bvh: Bvh,
  signed: boolean,
  axis: number,
  x: number,
  y: number,
  z: number,
  way: 1 | -1,
  scratch: PairScratch,
): number {
  const { boxes, links, corners } = bvh;
  const stack = scratch.stack;
  // u runs along the ray, v and w across it.
  const iu = axis;
  const iv = (axis + 1) % 3;
  const iw = (axis + 2) % 3;
  const u = axis === 0 ? x : axis === 1 ? y : z;
  const v = axis === 0 ? y : axis === 1 ? z : x;
  const w = axis === 0 ? z : axis === 1 ? x : y;
  let count = 0;
  let top = 0;
  let node = 0;
  for (;;) {
    const at = 6 * node;
    if (
      Math.abs(v - boxes[at + iv]!) <= boxes[at + 3 + iv]! &&
      Math.abs(w - boxes[at + iw]!) <= boxes[at + 3 + iw]! &&
      (boxes[at + iu]! - u) * way >= -boxes[at + 3 + iu]!
    ) {
      const triangles = links[2 * node + 1]!;
      if (triangles === 0) {
        stack[top++] = links[2 * node]!;
        node++;
        continue;
      }
      const first = links[2 * node]!;
      for (let t = 9 * first; t < 9 * (first + triangles); t += 9) {
        const side = crosses(corners, t, iu, iv, iw, u, v, w, way);
        count += signed ? side * way : Math.abs(side);
      }
    }
    if (top === 0) return count;
    node = stack[--top]!;
  }
}

/**
 * 1 where the ray crosses the triangle and the triangle faces growing u, −1 where it faces away, 0 where it is not
 * crossed.
 */
function crosses(
  c: Float64Array,
  t: number,
  iu: number,
  iv: number,
  iw: number,
  u: number,
  v: number,
  w: number,
  way: 1 | -1,
): number {
  const av = c[t + iv]!;
  const aw = c[t + iw]!;
  const bv = c[t + 3 + iv]!;
  const bw = c[t + 3 + iw]!;
  const cv = c[t + 6 + iv]!;
  const cw = c[t + 6 + iw]!;
  if (edgeBeside(av, aw, bv, bw, v, w) === edgeBeside(bv, bw, cv, cw, v, w)) {
    if (!edgeBeside(cv, cw, av, aw, v, w)) return 0;
  } else if (edgeBeside(cv, cw, av, aw, v, w)) return 0;
  const au = c[t + iu]!;
  const eu = c[t + 3 + iu]! - au;
  const fu = c[t + 6 + iu]! - au;
  const ev = bv - av;
  const ew = bw - aw;
  const fv = cv - av;
  const fw = cw - aw;
  const nu = ev * fw - ew * fv;
  if (nu === 0) return 0;
  // The plane through the corners at (v, w): n · (point − a) = 0.
  const nv = ew * fu - eu * fw;
  const nw = eu * fv - ev * fu;
  return (au - (nv * (v - av) + nw * (w - aw)) / nu - u) * way > 0 ? Math.sign(nu) : 0;
}

/** Whether the edge passes the point on the side of growing v at height w. The lower end always comes first. */
function edgeBeside(av: number, aw: number, bv: number, bw: number, v: number, w: number): boolean {
  if (aw > w === bw > w) return false;
  return aw < bw ? (bv - av) * (w - aw) > (v - av) * (bw - aw) : (av - bv) * (w - bw) > (v - bv) * (aw - bw);
}
