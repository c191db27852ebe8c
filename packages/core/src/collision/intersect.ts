import { LEAF_TRIANGLES, type Bvh } from "./bvh.ts";
import { movePoints, rigid, type Rigid } from "./relative.ts";
import { trianglesTouch } from "./triangles.ts";

/**
 * Working memory of the pair queries: one per caller, never shared between workers. It grows to the deepest pair met.
 */
export interface PairScratch {
  stack: Int32Array;
  bounds: Float64Array;
  readonly triangles: Float64Array;
  readonly relative: Rigid;
  readonly point: Float64Array;
  readonly ball: Float64Array;
  /** Number of the two triangles that were found to touch, in the order of the trees. */
  readonly witness: Int32Array;
}

export const pairScratch = (): PairScratch => ({
  stack: new Int32Array(512),
  bounds: new Float64Array(256),
  triangles: new Float64Array(9 * LEAF_TRIANGLES),
  relative: rigid(),
  point: new Float64Array(3),
  ball: new Float64Array(3),
  witness: new Int32Array(2),
});

/** Makes room for a walk down both trees: each step down leaves at most one pair behind. */
export function makeRoom(scratch: PairScratch, a: Bvh, b: Bvh): void {
  const pairs = a.depth + b.depth + 4;
  if (scratch.stack.length >= 2 * pairs) return;
  scratch.stack = new Int32Array(2 * pairs);
  scratch.bounds = new Float64Array(pairs);
}

/** Extra half length of every box, per unit: rotations carry rounding errors, and edges may be parallel. */
const SLACK = 1e-9;

/**
 * Whether the surfaces of two meshes share a point. Nothing is said about one lying inside the other: see `solid.ts`.
 * Boxes of `b` are seen from `a` as turned boxes; one rotation serves all of them, so a box pair costs 15 axes at most.
 *
 * @param aFromB   pose of b's frame in a's frame.
 * @param scratch  working memory; receives the touching triangles in `witness`. The call allocates nothing.
 * @see Gottschalk, Lin, Manocha, OBBTree: a hierarchical structure for rapid interference detection, SIGGRAPH 1996.
 */
export function surfacesTouch(a: Bvh, b: Bvh, aFromB: Rigid, scratch: PairScratch): boolean {
  makeRoom(scratch, a, b);
  const stack = scratch.stack;
  const boxesA = a.boxes;
  const boxesB = b.boxes;
  const linksA = a.links;
  const linksB = b.links;
  if (!boxesTouch(boxesA, 0, boxesB, 0, aFromB)) return false;
  let nodeA = 0;
  let nodeB = 0;
  let top = 0;
  for (;;) {
    const countA = linksA[2 * nodeA + 1]!;
    const countB = linksB[2 * nodeB + 1]!;
    if (countA > 0 && countB > 0) {
      if (leavesTouch(a, linksA[2 * nodeA]!, countA, b, linksB[2 * nodeB]!, countB, aFromB, scratch)) return true;
    } else if (countB > 0 || (countA === 0 && size(boxesA, 6 * nodeA) >= size(boxesB, 6 * nodeB))) {
      const first = nodeA + 1;
      const second = linksA[2 * nodeA]!;
      const goFirst = boxesTouch(boxesA, 6 * first, boxesB, 6 * nodeB, aFromB);
      const goSecond = boxesTouch(boxesA, 6 * second, boxesB, 6 * nodeB, aFromB);
      if (goFirst && goSecond) {
        stack[top++] = second;
        stack[top++] = nodeB;
      }
      if (goFirst || goSecond) {
        nodeA = goFirst ? first : second;
        continue;
      }
    } else {
      const first = nodeB + 1;
      const second = linksB[2 * nodeB]!;
      const goFirst = boxesTouch(boxesA, 6 * nodeA, boxesB, 6 * first, aFromB);
      const goSecond = boxesTouch(boxesA, 6 * nodeA, boxesB, 6 * second, aFromB);
      if (goFirst && goSecond) {
        stack[top++] = nodeA;
        stack[top++] = second;
      }
      if (goFirst || goSecond) {
        nodeB = goFirst ? first : second;
        continue;
      }
    }
    if (top === 0) return false;
    nodeB = stack[--top]!;
    nodeA = stack[--top]!;
  }
}

/** The sum of the half lengths: which of two boxes to open first. */
export const size = (boxes: Float64Array, at: number): number => boxes[at + 3]! + boxes[at + 4]! + boxes[at + 5]!;

function leavesTouch(
  a: Bvh,
  fromA: number,
  countA: number,
  b: Bvh,
  fromB: number,
  countB: number,
  aFromB: Rigid,
  scratch: PairScratch,
): boolean {
  const moved = scratch.triangles;
  movePoints(aFromB, b.corners, 9 * fromB, 3 * countB, moved, 0);
  for (let i = 0; i < countA; i++)
    for (let j = 0; j < countB; j++) {
      if (!trianglesTouch(a.corners, 9 * (fromA + i), moved, 9 * j)) continue;
      scratch.witness[0] = fromA + i;
      scratch.witness[1] = fromB + j;
      return true;
    }
  return false;
}

/** Whether box i of a and box j of b overlap, b seen through `m`. Never false for boxes that share a point. */
export function boxesTouch(boxesA: Float64Array, i: number, boxesB: Float64Array, j: number, m: Rigid): boolean {
  const r00 = m[0]!;
  const r01 = m[1]!;
  const r02 = m[2]!;
  const r10 = m[3]!;
  const r11 = m[4]!;
  const r12 = m[5]!;
  const r20 = m[6]!;
  const r21 = m[7]!;
  const r22 = m[8]!;
  const bx = boxesB[j]!;
  const by = boxesB[j + 1]!;
  const bz = boxesB[j + 2]!;
  const b0 = boxesB[j + 3]!;
  const b1 = boxesB[j + 4]!;
  const b2 = boxesB[j + 5]!;
  const a0 = boxesA[i + 3]!;
  const a1 = boxesA[i + 4]!;
  const a2 = boxesA[i + 5]!;

  const q00 = Math.abs(r00) + SLACK;
  const q01 = Math.abs(r01) + SLACK;
  const q02 = Math.abs(r02) + SLACK;
  const tx = r00 * bx + r01 * by + r02 * bz + m[9]! - boxesA[i]!;
  if (Math.abs(tx) > a0 + b0 * q00 + b1 * q01 + b2 * q02) return false;
  const q10 = Math.abs(r10) + SLACK;
  const q11 = Math.abs(r11) + SLACK;
  const q12 = Math.abs(r12) + SLACK;
  const ty = r10 * bx + r11 * by + r12 * bz + m[10]! - boxesA[i + 1]!;
  if (Math.abs(ty) > a1 + b0 * q10 + b1 * q11 + b2 * q12) return false;
  const q20 = Math.abs(r20) + SLACK;
  const q21 = Math.abs(r21) + SLACK;
  const q22 = Math.abs(r22) + SLACK;
  const tz = r20 * bx + r21 * by + r22 * bz + m[11]! - boxesA[i + 2]!;
  if (Math.abs(tz) > a2 + b0 * q20 + b1 * q21 + b2 * q22) return false;

  if (Math.abs(tx * r00 + ty * r10 + tz * r20) > b0 + a0 * q00 + a1 * q10 + a2 * q20) return false;
  if (Math.abs(tx * r01 + ty * r11 + tz * r21) > b1 + a0 * q01 + a1 * q11 + a2 * q21) return false;
  if (Math.abs(tx * r02 + ty * r12 + tz * r22) > b2 + a0 * q02 + a1 * q12 + a2 * q22) return false;

  if (Math.abs(tz * r10 - ty * r20) > a1 * q20 + a2 * q10 + b1 * q02 + b2 * q01) return false;
  if (Math.abs(tz * r11 - ty * r21) > a1 * q21 + a2 * q11 + b0 * q02 + b2 * q00) return false;
  if (Math.abs(tz * r12 - ty * r22) > a1 * q22 + a2 * q12 + b0 * q01 + b1 * q00) return false;
  if (Math.abs(tx * r20 - tz * r00) > a0 * q20 + a2 * q00 + b1 * q12 + b2 * q11) return false;
  if (Math.abs(tx * r21 - tz * r01) > a0 * q21 + a2 * q01 + b0 * q12 + b2 * q10) return false;
  if (Math.abs(tx * r22 - tz * r02) > a0 * q22 + a2 * q02 + b0 * q11 + b1 * q10) return false;
  if (Math.abs(ty * r00 - tx * r10) > a0 * q10 + a1 * q00 + b1 * q22 + b2 * q21) return false;
  if (Math.abs(ty * r01 - tx * r11) > a0 * q11 + a1 * q01 + b0 * q22 + b2 * q20) return false;
  return Math.abs(ty * r02 - tx * r12) <= a0 * q12 + a1 * q02 + b0 * q21 + b1 * q20;
}
