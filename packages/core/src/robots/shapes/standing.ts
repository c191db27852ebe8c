import type { TriangleMesh } from "../../mesh/mesh.ts";
import type { OrthoParallelGeometry } from "../../model/robot.ts";
import { prism, type Frame } from "./loft.ts";
import type { Outline, Point2 } from "./outline.ts";

/**
 * Places of the joints with all formula angles zero: the arm stands straight up, seen from the base [m].
 * The upper arm hangs on the −y side of the shoulder and carries the elbow back to the middle, so that the forearm
 * folds past it.
 */
export interface Standing {
  readonly axis1: { readonly x: number; readonly z: number };
  readonly elbow: { readonly x: number; readonly z: number };
  readonly wrist: { readonly x: number; readonly z: number };
  readonly flange_z: number;
  readonly y: number;
  /** Thickness of everything, 1 for the RX90L. */
  readonly size: number;
}

export function standing(geometry: OrthoParallelGeometry): Standing {
  const { a1_m, a2_m, b_m, c1_m, c2_m, c3_m, c4_m } = geometry;
  return {
    axis1: { x: a1_m, z: c1_m },
    elbow: { x: a1_m, z: c1_m + c2_m },
    wrist: { x: a1_m + a2_m, z: c1_m + c2_m + c3_m },
    flange_z: c1_m + c2_m + c3_m + c4_m,
    y: b_m,
    size: (c2_m + c3_m) / 1.1,
  };
}

/** A straight convex shell between two heights. */
export const shell = (frame: Frame, outline: Outline, from_m: number, to_m: number): TriangleMesh =>
  prism(frame, outline, [
    [0, from_m],
    [0, to_m],
  ]);

/** Lengths drawn for the RX90L, made larger or smaller with the arm. */
export const sized = (size: number, points: readonly Point2[]): Point2[] =>
  points.map(([a, b]) => [a * size, b * size] as const);
