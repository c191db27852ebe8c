import type { TriangleMesh } from "@twincell/core";
import { Refusal } from "../refusal.ts";

/** Cubes along the longest side at first; fewer where the surface would take too many triangles. */
const FINEST = 160;
const MOST_TRIANGLES = 60_000;

/** A cloud of points as a closed surface that can be shown, measured and collided with. */
export interface CloudSurface {
  readonly mesh: TriangleMesh;
  /** Side of a cube: every point lies in one, and no place of the surface is farther than its diagonal from a point. */
  readonly cube: number;
  readonly points: number;
  readonly notFinite: number;
}

/**
 * The surface around all cubes of a grid that hold a point (row N-65): nothing is made up between the points, and
 * nothing that was scanned is missed in a collision check. The grid becomes coarser until the surface has at most
 * 60,000 triangles.
 *
 * @param positions  x y z of each point, any unit; the answer has the same.
 * @throws {Refusal} when no point has finite coordinates.
 */
export function cloudSurface(positions: Float64Array): CloudSurface {
  const lower = [Infinity, Infinity, Infinity];
  const upper = [-Infinity, -Infinity, -Infinity];
  let points = 0;
  for (let at = 0; at + 2 < positions.length; at += 3) {
    if (!isFinitePoint(positions, at)) continue;
    points++;
    for (let k = 0; k < 3; k++) {
      lower[k] = Math.min(lower[k]!, positions[at + k]!);
      upper[k] = Math.max(upper[k]!, positions[at + k]!);
    }
  }
  if (points === 0) throw new Refusal("The cloud has no point with three finite coordinates.");
  const longest = Math.max(...[0, 1, 2].map(k => upper[k]! - lower[k]!)) || 1e-3;
  for (let cubes = FINEST; ; cubes /= 1.3) {
    const cube = longest / cubes;
    const cells = occupied(positions, lower, cube);
    const mesh = boundary(cells, lower, cube);
    if (mesh) return { mesh, cube, points, notFinite: positions.length / 3 - points };
  }
}

const isFinitePoint = (positions: Float64Array, at: number): boolean =>
  Math.abs(positions[at]!) < 1e9 && Math.abs(positions[at + 1]!) < 1e9 && Math.abs(positions[at + 2]!) < 1e9;

/** Cubes along each axis at most: the key of a cube is one whole number. */
const WIDTH = 1024;
const keyOf = (i: number, j: number, k: number): number => ((i + 1) * WIDTH + j + 1) * WIDTH + k + 1;

function occupied(positions: Float64Array, lower: readonly number[], cube: number): Set<number> {
  const cells = new Set<number>();
  for (let at = 0; at + 2 < positions.length; at += 3) {
    if (!isFinitePoint(positions, at)) continue;
    const [i, j, k] = [0, 1, 2].map(axis => Math.floor((positions[at + axis]! - lower[axis]!) / cube));
    cells.add(keyOf(i!, j!, k!));
  }
  return cells;
}

/** Steps to the six neighbours, each with the four corners of the side towards it, counter-clockwise from outside. */
const SIDES: readonly (readonly [step: number, corners: readonly (readonly [number, number, number])[]])[] = [
  [
    WIDTH * WIDTH,
    [
      [1, 0, 0],
      [1, 1, 0],
      [1, 1, 1],
      [1, 0, 1],
    ],
  ],
  [
    -WIDTH * WIDTH,
    [
      [0, 0, 0],
      [0, 0, 1],
      [0, 1, 1],
      [0, 1, 0],
    ],
  ],
  [
    WIDTH,
    [
      [0, 1, 0],
      [0, 1, 1],
      [1, 1, 1],
      [1, 1, 0],
    ],
  ],
  [
    -WIDTH,
    [
      [0, 0, 0],
      [1, 0, 0],
      [1, 0, 1],
      [0, 0, 1],
    ],
  ],
  [
    1,
    [
      [0, 0, 1],
      [1, 0, 1],
      [1, 1, 1],
      [0, 1, 1],
    ],
  ],
  [
    -1,
    [
      [0, 0, 0],
      [0, 1, 0],
      [1, 1, 0],
      [1, 0, 0],
    ],
  ],
];

function boundary(cells: ReadonlySet<number>, lower: readonly number[], cube: number): TriangleMesh | undefined {
  const vertices = new Map<number, number>();
  const positions: number[] = [];
  const indices: number[] = [];
  const vertexAt = (i: number, j: number, k: number): number => {
    const key = keyOf(i, j, k);
    const known = vertices.get(key);
    if (known !== undefined) return known;
    const made = vertices.size;
    vertices.set(key, made);
    positions.push(lower[0]! + i * cube, lower[1]! + j * cube, lower[2]! + k * cube);
    return made;
  };
  for (const key of cells) {
    const k = (key % WIDTH) - 1;
    const j = (Math.floor(key / WIDTH) % WIDTH) - 1;
    const i = Math.floor(key / (WIDTH * WIDTH)) - 1;
    for (const [step, corners] of SIDES) {
      if (cells.has(key + step)) continue;
      const [a, b, c, d] = corners.map(([x, y, z]) => vertexAt(i + x, j + y, k + z));
      indices.push(a!, b!, c!, a!, c!, d!);
    }
    if (indices.length > 3 * MOST_TRIANGLES) return undefined;
  }
  return { positions: Float64Array.from(positions), indices: Uint32Array.from(indices) };
}
