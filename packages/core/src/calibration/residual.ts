import { distance, type Vector3 } from "../spatial/vector.ts";

/** How far measured points lie from where the answer puts them. */
export interface Residual {
  /** √(Σ d² / n). */
  readonly rms_m: number;
  /** The largest, and whose it is, counted from 1. */
  readonly worst_m: number;
  readonly worst: number;
  readonly each_m: readonly number[];
}

export function residualOf(measured: readonly Vector3[], computed: readonly Vector3[]): Residual {
  const each_m = measured.map((point, i) => distance(point, computed[i]!));
  const worst_m = Math.max(...each_m);
  return {
    rms_m: Math.sqrt(each_m.reduce((sum, d) => sum + d * d, 0) / each_m.length),
    worst_m,
    worst: each_m.indexOf(worst_m) + 1,
    each_m,
  };
}

export const meanOf = (points: readonly Vector3[]): Vector3 =>
  [0, 1, 2].map(axis => points.reduce((sum, point) => sum + point[axis]!, 0) / points.length) as Vector3;

export const isFinitePoint = (point: readonly number[]): boolean => point.length === 3 && point.every(Number.isFinite);
