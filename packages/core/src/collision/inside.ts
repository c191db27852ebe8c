import type { Bvh } from "./bvh.ts";
import type { PairScratch } from "./intersect.ts";

/**
 * Whether a point lies inside the surface: a ray from it crosses the surface an odd number of times. In a shell with
 * open borders one ray may slip out, so six rays vote there and four must agree.
 *
 * The rays run along the axes, and an edge is crossed by the half-open rule in the plane across the ray, computed the
 * same way for both of its triangles: a ray through an edge or a corner counts once, never twice and never not at all.
 */
export function pointInside(bvh: Bvh, closed: boolean, x: number, y: number, z: number, scratch: PairScratch): boolean {
  const box = bvh.boxes;
  if (Math.abs(x - box[0]!) > box[3]! || Math.abs(y - box[1]!) > box[4]! || Math.abs(z - box[2]!) > box[5]!) return false;
  if (closed) return isOdd(crossings(bvh, 0, x, y, z, 1, scratch));
  let odd = 0;
  for (let axis = 0; axis < 3; axis++) for (const way of BOTH_WAYS) if (isOdd(crossings(bvh, axis, x, y, z, way, scratch))) odd++;
  return odd >= 4;
}

const BOTH_WAYS = [1, -1] as const;
const isOdd = (n: number): boolean => (n & 1) === 1;

/** How often the ray from the point along `way` times the axis crosses the surface. */
function crossings(bvh: Bvh, axis: number, x: number, y: number, z: number, way: 1 | -1, scratch: PairScratch): number {
  const { boxes, links, corners } = bvh, stack = scratch.stack;
  // u runs along the ray, v and w across it.
  const iu = axis, iv = (axis + 1) % 3, iw = (axis + 2) % 3;
  const u = axis === 0 ? x : axis === 1 ? y : z, v = axis === 0 ? y : axis === 1 ? z : x, w = axis === 0 ? z : axis === 1 ? x : y;
  let count = 0, top = 0, node = 0;
  for (;;) {
    const at = 6 * node;
    if (Math.abs(v - boxes[at + iv]!) <= boxes[at + 3 + iv]! && Math.abs(w - boxes[at + iw]!) <= boxes[at + 3 + iw]!
      && (boxes[at + iu]! - u) * way >= -boxes[at + 3 + iu]!) {
      const triangles = links[2 * node + 1]!;
      if (triangles === 0) {
        stack[top++] = links[2 * node]!;
        node++;
        continue;
      }
      const first = links[2 * node]!;
      for (let t = 9 * first; t < 9 * (first + triangles); t += 9) if (crosses(corners, t, iu, iv, iw, u, v, w, way)) count++;
    }
    if (top === 0) return count;
    node = stack[--top]!;
  }
}

function crosses(c: Float64Array, t: number, iu: number, iv: number, iw: number, u: number, v: number, w: number, way: 1 | -1): boolean {
  const av = c[t + iv]!, aw = c[t + iw]!, bv = c[t + 3 + iv]!, bw = c[t + 3 + iw]!, cv = c[t + 6 + iv]!, cw = c[t + 6 + iw]!;
  if (edgeBeside(av, aw, bv, bw, v, w) === edgeBeside(bv, bw, cv, cw, v, w)) {
    if (!edgeBeside(cv, cw, av, aw, v, w)) return false;
  } else if (edgeBeside(cv, cw, av, aw, v, w)) return false;
  const au = c[t + iu]!, eu = c[t + 3 + iu]! - au, fu = c[t + 6 + iu]! - au, ev = bv - av, ew = bw - aw, fv = cv - av, fw = cw - aw;
  const nu = ev * fw - ew * fv;
  if (nu === 0) return false;
  // The plane through the corners at (v, w): n · (point − a) = 0.
  const nv = ew * fu - eu * fw, nw = eu * fv - ev * fu;
  return (au - (nv * (v - av) + nw * (w - aw)) / nu - u) * way > 0;
}

/** Whether the edge passes the point on the side of growing v at height w. The lower end always comes first. */
function edgeBeside(av: number, aw: number, bv: number, bw: number, v: number, w: number): boolean {
  if ((aw > w) === (bw > w)) return false;
  return aw < bw ? (bv - av) * (w - aw) > (v - av) * (bw - aw) : (av - bv) * (w - bw) > (v - bv) * (aw - bw);
}
