import type { PathPiece, Vector3 } from "@twincell/core";
import type { Ray } from "../handle/drag-maths.ts";

export interface PathPick {
  readonly step: string;
  /** From the start of the program [s]. */
  readonly at_s: number;
}

/**
 * The place of the path that is nearest to a ray, seen from its origin, if the angle between them is small enough.
 * `ray.direction` has the length 1.
 */
export function pathUnder(path: readonly PathPiece[], ray: Ray, tolerance_rad: number): PathPick | undefined {
  let best: PathPick | undefined;
  let least_rad = tolerance_rad;
  for (const { step, from_s, to_s, points } of path)
    for (let i = 1; i < points.length; i++) {
      const near = nearest(points[i - 1]!, points[i]!, ray);
      if (near.angle_rad >= least_rad) continue;
      least_rad = near.angle_rad;
      best = { step, at_s: from_s + ((to_s - from_s) * (i - 1 + near.share)) / (points.length - 1) };
    }
  return best;
}

/** The point of a segment that is nearest to the ray: its share of the way, and how far off the ray it is seen. */
function nearest(a: Vector3, b: Vector3, { origin, direction: d }: Ray): { share: number; angle_rad: number } {
  const ab = [b[0] - a[0], b[1] - a[1], b[2] - a[2]] as const;
  const oa = [a[0] - origin[0], a[1] - origin[1], a[2] - origin[2]] as const;
  const abd = ab[0] * d[0] + ab[1] * d[1] + ab[2] * d[2];
  const oad = oa[0] * d[0] + oa[1] * d[1] + oa[2] * d[2];
  // Perpendicular to the ray: minimise |oa⊥ + s ab⊥|.
  const square = ab[0] * ab[0] + ab[1] * ab[1] + ab[2] * ab[2] - abd * abd;
  const across = ab[0] * oa[0] + ab[1] * oa[1] + ab[2] * oa[2] - abd * oad;
  const share = square < 1e-18 ? 0 : Math.min(1, Math.max(0, -across / square));
  const depth = oad + share * abd;
  if (depth <= 0) return { share, angle_rad: Math.PI };
  const off = [0, 1, 2].map(k => oa[k as 0] + share * ab[k as 0] - depth * d[k as 0]);
  return { share, angle_rad: Math.atan2(Math.hypot(...off), depth) };
}
