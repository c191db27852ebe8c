import type { Bvh } from "./bvh.ts";
import { makeRoom, size, type PairScratch } from "./intersect.ts";
import { movePoints, type Rigid } from "./relative.ts";
import { segmentDistance2, triangleDistance2 } from "./triangle-distance.ts";

/** Kept between the steps of one search: the least squared distance so far [m²]. */
const LEAST = new Float64Array(1);
/** Kept between the steps of one search: the pair of nodes looked at, and how much the stack holds. */
const PAIR = new Int32Array(3);
const NODE_A = 0;
const NODE_B = 1;
const TOP = 2;

/**
 * Distance between two surfaces [m] when it is below `cutoff_m`, else Infinity. 0 when they share a point.
 *
 * @param aFromB   pose of b's frame in a's frame.
 * @param out      receives the nearest point of a and of b, both in a's frame [m]; unchanged for Infinity.
 * @param scratch  working memory. `scratch.witness` names a pair of triangles to begin with, when it holds numbers ≥ 0
 *                 (last time's nearest pair prunes best), and receives the nearest pair. The call allocates nothing.
 * @param enough_m  the search ends with the first pair of triangles nearer than this: 0 for the true distance; the
 *   cut-off
 *                  when it only matters whether anything is nearer.
 * @see Larsen, Gottschalk, Lin, Manocha, Fast distance queries with rectangular swept sphere volumes, ICRA 2000.
 */
export function surfaceDistance(
  a: Bvh,
  b: Bvh,
  aFromB: Rigid,
  cutoff_m: number,
  scratch: PairScratch,
  out: Float64Array,
  enough_m = 0,
): number {
  if (a.source.length === 0 || b.source.length === 0) return Infinity;
  makeRoom(scratch, a, b);
  const linksA = a.links;
  const linksB = b.links;
  const enough = enough_m * enough_m;
  const cutoff = cutoff_m * cutoff_m;
  LEAST[0] = cutoff;
  tryWitness(a, b, aFromB, scratch, out);
  if (LEAST[0] < cutoff && LEAST[0] < enough) return Math.sqrt(LEAST[0]);
  PAIR[NODE_A] = 0;
  PAIR[NODE_B] = 0;
  PAIR[TOP] = 0;
  let goesOn = boxDistance2(a.boxes, 0, b.boxes, 0, aFromB) < LEAST[0];
  while (goesOn) {
    const nodeA = PAIR[NODE_A]!;
    const nodeB = PAIR[NODE_B]!;
    const countA = linksA[2 * nodeA + 1]!;
    const countB = linksB[2 * nodeB + 1]!;
    if (countA > 0 && countB > 0) {
      const fromA = linksA[2 * nodeA]!;
      const fromB = linksB[2 * nodeB]!;
      const near = nearestInLeaves(a, fromA, countA, b, fromB, countB, aFromB, LEAST[0], scratch, out);
      if (near < LEAST[0]) LEAST[0] = near;
    } else if (openPair(a, b, aFromB, countA, countB, scratch)) continue;
    goesOn = LEAST[0] > 0 && !(LEAST[0] < cutoff && LEAST[0] < enough) && takePair(scratch);
  }
  return LEAST[0] < cutoff ? Math.sqrt(LEAST[0]) : Infinity;
}

/** Begins with the pair of triangles that `scratch.witness` names, where it names one. */
function tryWitness(a: Bvh, b: Bvh, aFromB: Rigid, scratch: PairScratch, out: Float64Array): void {
  const first = scratch.witness[0]!;
  const second = scratch.witness[1]!;
  if (first < 0 || first >= a.source.length || second < 0 || second >= b.source.length) return;
  movePoints(aFromB, b.corners, 9 * second, 3, scratch.triangles, 0);
  const seed = triangleDistance2(a.corners, 9 * first, scratch.triangles, 0, LEAST[0]!, out);
  if (seed < LEAST[0]!) LEAST[0] = seed;
}

/**
 * Opens the larger node of the pair: the farther of the two new pairs goes on the stack, the nearer one is next.
 *
 * @returns whether a new pair is near enough to be next.
 */
function openPair(a: Bvh, b: Bvh, aFromB: Rigid, countA: number, countB: number, scratch: PairScratch): boolean {
  const nodeA = PAIR[NODE_A]!;
  const nodeB = PAIR[NODE_B]!;
  const best = LEAST[0]!;
  const openA = countB > 0 || (countA === 0 && size(a.boxes, 6 * nodeA) >= size(b.boxes, 6 * nodeB));
  const first = openA ? nodeA + 1 : nodeB + 1;
  const second = openA ? a.links[2 * nodeA]! : b.links[2 * nodeB]!;
  const toFirst = openA
    ? boxDistance2(a.boxes, 6 * first, b.boxes, 6 * nodeB, aFromB)
    : boxDistance2(a.boxes, 6 * nodeA, b.boxes, 6 * first, aFromB);
  const toSecond = openA
    ? boxDistance2(a.boxes, 6 * second, b.boxes, 6 * nodeB, aFromB)
    : boxDistance2(a.boxes, 6 * nodeA, b.boxes, 6 * second, aFromB);
  const near = toFirst <= toSecond ? first : second;
  const far = toFirst <= toSecond ? second : first;
  const farther = Math.max(toFirst, toSecond);
  if (farther < best) {
    const top = PAIR[TOP]!;
    scratch.bounds[top >> 1] = farther;
    scratch.stack[top] = openA ? far : nodeA;
    scratch.stack[top + 1] = openA ? nodeB : far;
    PAIR[TOP] = top + 2;
  }
  if (Math.min(toFirst, toSecond) >= best) return false;
  PAIR[openA ? NODE_A : NODE_B] = near;
  return true;
}

/** The next pair of nodes from the stack that may be nearer than the least distance; false when there is none. */
function takePair({ stack, bounds }: PairScratch): boolean {
  let top = PAIR[TOP]!;
  while (top > 0) {
    top -= 2;
    if (bounds[top >> 1]! >= LEAST[0]!) continue;
    PAIR[NODE_A] = stack[top]!;
    PAIR[NODE_B] = stack[top + 1]!;
    PAIR[TOP] = top;
    return true;
  }
  PAIR[TOP] = 0;
  return false;
}

/**
 * Whether every point of `outer` keeps a distance from `inner` that grows with its own distance r from outer's origin:
 * `near_m` + `perMetre` r. What turns about its own origin moves the more the farther out it is.
 *
 * @param scratch  as for `surfaceDistance`; `witness` is asked first and receives a pair of triangles that is too near.
 */
export function keepsApart(
  outer: Bvh,
  inner: Bvh,
  outerFromInner: Rigid,
  near_m: number,
  perMetre: number,
  scratch: PairScratch,
  out: Float64Array,
): boolean {
  if (outer.source.length === 0 || inner.source.length === 0) return true;
  makeRoom(scratch, outer, inner);
  const stack = scratch.stack;
  const linksA = outer.links;
  const linksB = inner.links;
  const reaches = outer.reaches;
  const first = scratch.witness[0]!;
  const second = scratch.witness[1]!;
  if (first >= 0 && second >= 0) {
    movePoints(outerFromInner, inner.corners, 9 * second, 3, scratch.triangles, 0);
    const wanted = near_m + perMetre * farthestCorner(outer.corners, 9 * first);
    if (triangleDistance2(outer.corners, 9 * first, scratch.triangles, 0, wanted * wanted, out) < wanted * wanted)
      return false;
  }
  let nodeA = 0;
  let nodeB = 0;
  let top = 0;
  for (;;) {
    const wanted = near_m + perMetre * reaches[nodeA]!;
    if (boxDistance2(outer.boxes, 6 * nodeA, inner.boxes, 6 * nodeB, outerFromInner) < wanted * wanted) {
      const countA = linksA[2 * nodeA + 1]!;
      const countB = linksB[2 * nodeB + 1]!;
      if (countA > 0 && countB > 0) {
        const limit = wanted * wanted;
        if (
          nearestInLeaves(
            outer,
            linksA[2 * nodeA]!,
            countA,
            inner,
            linksB[2 * nodeB]!,
            countB,
            outerFromInner,
            limit,
            scratch,
            out,
          ) < limit
        )
          return false;
      } else if (countB > 0 || (countA === 0 && size(outer.boxes, 6 * nodeA) >= size(inner.boxes, 6 * nodeB))) {
        stack[top++] = linksA[2 * nodeA]!;
        stack[top++] = nodeB;
        nodeA++;
        continue;
      } else {
        stack[top++] = nodeA;
        stack[top++] = linksB[2 * nodeB]!;
        nodeB++;
        continue;
      }
    }
    if (top === 0) return true;
    nodeB = stack[--top]!;
    nodeA = stack[--top]!;
  }
}

function farthestCorner(c: Float64Array, t: number): number {
  let squared = 0;
  for (let i = t; i < t + 9; i += 3)
    squared = Math.max(squared, c[i]! * c[i]! + c[i + 1]! * c[i + 1]! + c[i + 2]! * c[i + 2]!);
  return Math.sqrt(squared);
}

function nearestInLeaves(
  a: Bvh,
  fromA: number,
  countA: number,
  b: Bvh,
  fromB: number,
  countB: number,
  aFromB: Rigid,
  limit: number,
  scratch: PairScratch,
  out: Float64Array,
): number {
  const moved = scratch.triangles;
  const ball = scratch.ball;
  let best = limit;
  let reach = Math.sqrt(best);
  for (let j = 0; j < countB; j++) {
    movePoints(aFromB, b.balls, 4 * (fromB + j), 1, ball, 0);
    const bx = ball[0]!;
    const by = ball[1]!;
    const bz = ball[2]!;
    const br = b.balls[4 * (fromB + j) + 3]!;
    let here = false;
    for (let i = 0; i < countA; i++) {
      const at = 4 * (fromA + i);
      const dx = bx - a.balls[at]!;
      const dy = by - a.balls[at + 1]!;
      const dz = bz - a.balls[at + 2]!;
      const far = a.balls[at + 3]! + br + reach;
      if (dx * dx + dy * dy + dz * dz >= far * far) continue;
      if (!here) {
        movePoints(aFromB, b.corners, 9 * (fromB + j), 3, moved, 0);
        here = true;
      }
      // Slivers fill little of their balls but most of the capsules around their longest edges.
      const apart = reach + a.heights[fromA + i]! + b.heights[fromB + j]!;
      if (segmentDistance2(a.corners, 9 * (fromA + i), moved, 0) >= apart * apart) continue;
      const squared = triangleDistance2(a.corners, 9 * (fromA + i), moved, 0, best, out);
      if (squared >= best) continue;
      best = squared;
      reach = Math.sqrt(best);
      scratch.witness[0] = fromA + i;
      scratch.witness[1] = fromB + j;
    }
  }
  return best;
}

/** No more than the squared distance of two boxes [m²]: the gap between them along the axes of one and of the other. */
export function boxDistance2(boxesA: Float64Array, i: number, boxesB: Float64Array, j: number, m: Rigid): number {
  const r00 = m[0]!;
  const r01 = m[1]!;
  const r02 = m[2]!;
  const r10 = m[3]!;
  const r11 = m[4]!;
  const r12 = m[5]!;
  const r20 = m[6]!;
  const r21 = m[7]!;
  const r22 = m[8]!;
  const q00 = Math.abs(r00);
  const q01 = Math.abs(r01);
  const q02 = Math.abs(r02);
  const q10 = Math.abs(r10);
  const q11 = Math.abs(r11);
  const q12 = Math.abs(r12);
  const q20 = Math.abs(r20);
  const q21 = Math.abs(r21);
  const q22 = Math.abs(r22);
  const bx = boxesB[j]!;
  const by = boxesB[j + 1]!;
  const bz = boxesB[j + 2]!;
  const b0 = boxesB[j + 3]!;
  const b1 = boxesB[j + 4]!;
  const b2 = boxesB[j + 5]!;
  const a0 = boxesA[i + 3]!;
  const a1 = boxesA[i + 4]!;
  const a2 = boxesA[i + 5]!;
  const tx = r00 * bx + r01 * by + r02 * bz + m[9]! - boxesA[i]!;
  const ty = r10 * bx + r11 * by + r12 * bz + m[10]! - boxesA[i + 1]!;
  const tz = r20 * bx + r21 * by + r22 * bz + m[11]! - boxesA[i + 2]!;
  const gx = Math.abs(tx) - a0 - b0 * q00 - b1 * q01 - b2 * q02;
  const gy = Math.abs(ty) - a1 - b0 * q10 - b1 * q11 - b2 * q12;
  const gz = Math.abs(tz) - a2 - b0 * q20 - b1 * q21 - b2 * q22;
  const inA = (gx > 0 ? gx * gx : 0) + (gy > 0 ? gy * gy : 0) + (gz > 0 ? gz * gz : 0);
  const hx = Math.abs(tx * r00 + ty * r10 + tz * r20) - b0 - a0 * q00 - a1 * q10 - a2 * q20;
  const hy = Math.abs(tx * r01 + ty * r11 + tz * r21) - b1 - a0 * q01 - a1 * q11 - a2 * q21;
  const hz = Math.abs(tx * r02 + ty * r12 + tz * r22) - b2 - a0 * q02 - a1 * q12 - a2 * q22;
  const inB = (hx > 0 ? hx * hx : 0) + (hy > 0 ? hy * hy : 0) + (hz > 0 ? hz * hz : 0);
  return inA > inB ? inA : inB;
}
