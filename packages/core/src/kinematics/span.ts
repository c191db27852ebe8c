import type { OrthoParallelGeometry, Robot } from "../robots/robot.ts";
import { compose, inverse, pose, type Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** Distance of the wrist centre from the shoulder, and between which distances the arm can put it [m]. */
export interface Span { readonly distance_m: number; readonly nearest_m: number; readonly farthest_m: number }

/**
 * Shoulder to wrist centre of a wanted pose, in the plane that faces it:  |c2 − k| ≤ √(x² + z²) ≤ c2 + k,  k = √(a2² + c3²).
 * For a shoulder with an offset a1 the better of front and back counts. An arm set aside by b cannot come nearer to axis 1 than b.
 */
export function span(robot: Robot, baseFromFlange: Pose<"base", "flange">): Span {
  const family = robot.family;
  if (family.kind !== "ortho-parallel") return { distance_m: 0, nearest_m: 0, farthest_m: robot.reach_m };
  const { a1_m, a2_m, b_m, c1_m, c2_m, c3_m } = family, [x, y, z] = wristCentre(family, baseFromFlange);
  const k = Math.sqrt(a2_m * a2_m + c3_m * c3_m), u = Math.sqrt(Math.max(0, x * x + y * y - b_m * b_m)), up = z - c1_m;
  const farthest_m = c2_m + k, nearest_m = Math.abs(c2_m - k), aside = Math.sqrt(x * x + y * y);
  if (aside < Math.abs(b_m)) return { distance_m: aside, nearest_m: Math.abs(b_m), farthest_m };
  const front = Math.sqrt((u - a1_m) ** 2 + up * up), back = Math.sqrt((u + a1_m) ** 2 + up * up);
  const miss = (d: number): number => Math.max(d - farthest_m, nearest_m - d);
  return { distance_m: miss(front) <= miss(back) ? front : back, nearest_m, farthest_m };
}

/** Where axes 4, 5 and 6 meet, seen from the base [m]. */
export function wristCentre({ c4_m, formulaFromFlange }: OrthoParallelGeometry, baseFromFlange: Pose<"base", "flange">): Vector3 {
  return compose(compose(baseFromFlange, inverse(formulaFromFlange)), pose<"formula", "wrist">([0, 0, -c4_m])).position;
}
