import type { Pose } from "@twincell/core";

/**
 * A pose as a matrix: nine numbers row by row, and the origin in the unit of the language. Those who execute texts
 * compute with these alone: they share no arithmetic with the writers.
 */
export interface Matrix {
  readonly r: readonly number[];
  readonly p: readonly [number, number, number];
}

/** a·b */
export function times(a: Matrix, b: Matrix): Matrix {
  const r: number[] = [];
  for (let i = 0; i < 9; i += 3)
    for (let j = 0; j < 3; j++) r.push(a.r[i]! * b.r[j]! + a.r[i + 1]! * b.r[3 + j]! + a.r[i + 2]! * b.r[6 + j]!);
  const along = (row: number): number => a.r[row]! * b.p[0] + a.r[row + 1]! * b.p[1] + a.r[row + 2]! * b.p[2];
  return { r, p: [a.p[0] + along(0), a.p[1] + along(3), a.p[2] + along(6)] };
}

export function inverted({ r, p }: Matrix): Matrix {
  const back = (column: number): number => -(r[column]! * p[0] + r[column + 3]! * p[1] + r[column + 6]! * p[2]);
  return { r: [r[0]!, r[3]!, r[6]!, r[1]!, r[4]!, r[7]!, r[2]!, r[5]!, r[8]!], p: [back(0), back(1), back(2)] };
}

/** The nine numbers of a rotation, row by row. */
// biome-ignore format: table of numbers
export const rotationRows = ([x, y, z, w]: Pose["quaternion"]): readonly number[] => [
  1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
  2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
  2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y),
];
