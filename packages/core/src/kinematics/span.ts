import type { GeneralSixGeometry, OrthoParallelGeometry, Robot, ThreeParallelGeometry } from "../model/robot.ts";
import { compose, inverse, pose, type Pose } from "../spatial/pose.ts";
import { rotate } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** Distance of the wrist centre from the shoulder, and between which distances the arm can put it [m]. */
export interface Span {
  readonly distance_m: number;
  readonly nearest_m: number;
  readonly farthest_m: number;
}

/**
 * Shoulder to wrist of a wanted pose: what has to lie between two lengths for the arm to reach it. For an
 * ortho-parallel arm, in the plane that faces it:
 *   |c2 − k| ≤ √(x² + z²) ≤ c2 + k,  k = √(a2² + c3²).
 * For a shoulder with an offset a1 the better of front and back counts. An arm set aside by b cannot come nearer to
 * axis 1 than b.
 */
export function span(robot: Robot, baseFromFlange: Pose<"base", "flange">): Span {
  const family = robot.family;
  switch (family.kind) {
    case "ortho-parallel":
      return spanOfOrthoParallel(family, baseFromFlange);
    case "three-parallel":
      return spanOfThreeParallel(family, baseFromFlange);
    case "spherical-seven": {
      const {
        position: [x, y, z],
      } = wristSeen(family, baseFromFlange);
      const { c3_m, c5_m } = family;
      return {
        distance_m: Math.sqrt(x * x + y * y + z * z),
        nearest_m: Math.abs(c3_m - c5_m),
        farthest_m: c3_m + c5_m,
      };
    }
    case "general-6r":
      return spanOfGeneralSix(family, baseFromFlange);
    case "general":
      return { distance_m: 0, nearest_m: 0, farthest_m: robot.reach_m };
  }
}

function spanOfOrthoParallel(family: OrthoParallelGeometry, baseFromFlange: Pose<"base", "flange">): Span {
  const { a1_m, a2_m, b_m, c1_m, c2_m, c3_m } = family;
  const [x, y, z] = wristCentre(family, baseFromFlange);
  const k = Math.sqrt(a2_m * a2_m + c3_m * c3_m);
  const u = Math.sqrt(Math.max(0, x * x + y * y - b_m * b_m));
  const up = z - c1_m;
  const farthest_m = c2_m + k;
  const nearest_m = Math.abs(c2_m - k);
  const aside = Math.sqrt(x * x + y * y);
  if (aside < Math.abs(b_m)) return { distance_m: aside, nearest_m: Math.abs(b_m), farthest_m };
  const front = Math.sqrt((u - a1_m) ** 2 + up * up);
  const back = Math.sqrt((u + a1_m) ** 2 + up * up);
  const miss = (d: number): number => Math.max(d - farthest_m, nearest_m - d);
  return { distance_m: miss(front) <= miss(back) ? front : back, nearest_m, farthest_m };
}

/**
 * Joint 4 is what has to be within reach of the shoulder; of the up to four places it may be in, the one that misses
 * least.
 */
function spanOfThreeParallel(family: ThreeParallelGeometry, baseFromFlange: Pose<"base", "flange">): Span {
  const { a1_m, b_m, c2_m, c3_m, c5_m } = family;
  const {
    position: [x, y, z],
    quaternion,
  } = wristSeen(family, baseFromFlange);
  const farthest_m = c2_m + c3_m;
  const nearest_m = Math.abs(c2_m - c3_m);
  const aside = Math.sqrt(x * x + y * y);
  const u = Math.sqrt(Math.max(0, x * x + y * y - b_m * b_m));
  if (aside < Math.abs(b_m)) return { distance_m: aside, nearest_m: Math.abs(b_m), farthest_m };
  const tip = rotate(quaternion, [0, 1, 0]);
  const miss = (d: number): number => Math.max(d - farthest_m, nearest_m - d);
  let best = Infinity;
  for (const ahead of [u, -u]) {
    // Axis 5 is square to axis 2 and to axis 6: its direction in the arm's plane is known but for its sign.
    const heading = Math.atan2(y, x) - Math.atan2(b_m, ahead);
    const inPlane = tip[0] * Math.cos(heading) + tip[1] * Math.sin(heading);
    const length = Math.hypot(inPlane, tip[2]);
    for (const side of [1, -1]) {
      const dx = length > 1e-9 ? (side * tip[2]) / length : 0;
      const dz = length > 1e-9 ? (-side * inPlane) / length : side;
      const d = Math.hypot(ahead - a1_m - c5_m * dx, z - c5_m * dz);
      if (!(miss(d) >= miss(best))) best = d;
    }
  }
  return { distance_m: best, nearest_m, farthest_m };
}

/**
 * The meeting of axes 4 and 5 runs on a circle about axis 6; of its places the one that misses least, to half a degree.
 */
function spanOfGeneralSix(family: GeneralSixGeometry, baseFromFlange: Pose<"base", "flange">): Span {
  const { a1_m, b_m, c2_m, e_m, centre_m } = family;
  const { position, quaternion } = wristSeen(family, baseFromFlange);
  const k = Math.hypot(...centre_m);
  const farthest_m = c2_m + k;
  const nearest_m = Math.abs(c2_m - k);
  const miss = (d: number): number => Math.max(d - farthest_m, nearest_m - d);
  let best = Infinity;
  for (let i = 0; i < 720; i++) {
    const [ox, oy, oz] = rotate(quaternion, [
      e_m * Math.cos((i * Math.PI) / 360),
      e_m * Math.sin((i * Math.PI) / 360),
      0,
    ]);
    const x = position[0] - ox;
    const y = position[1] - oy;
    const z = position[2] - oz;
    const u = Math.sqrt(Math.max(0, x * x + y * y - b_m * b_m));
    for (const ahead of [u, -u]) {
      const d = Math.hypot(ahead - a1_m, z);
      if (!(miss(d) >= miss(best))) best = d;
    }
  }
  return { distance_m: best, nearest_m, farthest_m };
}

/** The wanted wrist frame, seen from the formula's origin. */
const wristSeen = (
  { baseFromFormula, wristFromFlange }: Pick<ThreeParallelGeometry, "baseFromFormula" | "wristFromFlange">,
  baseFromFlange: Pose<"base", "flange">,
): Pose<"formula", "wrist"> => compose(compose(inverse(baseFromFormula), baseFromFlange), inverse(wristFromFlange));

/** Where axes 4, 5 and 6 meet, seen from the base [m]. */
export function wristCentre(
  { c4_m, formulaFromFlange }: OrthoParallelGeometry,
  baseFromFlange: Pose<"base", "flange">,
): Vector3 {
  return compose(compose(baseFromFlange, inverse(formulaFromFlange)), pose<"formula", "wrist">([0, 0, -c4_m])).position;
}
