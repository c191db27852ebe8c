import {
  add,
  addScaled,
  cross,
  dot,
  fromAxisAngle,
  multiply,
  norm,
  rotate,
  scale,
  subtract,
  type Pose,
  type Quaternion,
  type SurfaceFeature,
  type Vector3,
} from "@twincell/core";

/** How one object is put to another: face to face, or axis to axis. All in the world. */
export interface MateOptions {
  /** Faces look the same way instead of at each other; axes run against each other. */
  readonly flipped?: boolean;
  /** Gap between the faces, or between two round edges along their axis [m]. */
  readonly offset_m?: number;
}

export type Mated =
  | { readonly kind: "mated"; readonly worldFromObject: Pose<"world", "object"> }
  /** A face and an axis have no common direction to be put along. */
  | { readonly kind: "no-mate" };

/**
 * Where an object stands when a feature of it is put to a feature of another, turned by the least angle that does it:
 *
 *   planes     n' = −n_f, and p' = p_f + offset · n_f: the picked points meet
 *   axes       a' = ±a_f, the nearer, and p' on the other's line; along the line it stays
 *   two rims   as axes, and their middles `offset` apart along the axis
 *
 * @param worldFromObject  of the object that moves, before.
 * @param moving, fixed    features as picked, in the world before the move [m].
 */
export function matedPose(
  worldFromObject: Pose<"world", "object">,
  moving: SurfaceFeature,
  fixed: SurfaceFeature,
  { flipped = false, offset_m = 0 }: MateOptions = {},
): Mated {
  const isPlane = moving.kind === "plane";
  if (isPlane !== (fixed.kind === "plane")) return { kind: "no-mate" };
  const nearer = dot(moving.axis, fixed.axis) < 0 ? -1 : 1;
  const sign = (isPlane ? -1 : nearer) * (flipped ? -1 : 1);
  const turn = shortestTurn(moving.axis, scale(fixed.axis, sign));
  const gap = subtract(moving.center_m, fixed.center_m);
  // The picked point is what the turn is about: only a shift is left.
  const meets = isPlane || (moving.kind === "circle" && fixed.kind === "circle");
  const shift = meets
    ? addScaled(scale(gap, -1), fixed.axis, offset_m)
    : subtract(scale(fixed.axis, dot(gap, fixed.axis)), gap);
  const arm = rotate(turn, subtract(worldFromObject.position as Vector3, moving.center_m));
  return {
    kind: "mated",
    worldFromObject: {
      position: add(add(moving.center_m, arm), shift),
      quaternion: multiply(turn, worldFromObject.quaternion as Quaternion),
    },
  };
}

/** The least turn from one unit vector to another; half a turn is made about an upright axis where that is across. */
function shortestTurn(from: Vector3, to: Vector3): Quaternion {
  const across = cross(from, to);
  const sine = norm(across);
  const cosine = dot(from, to);
  if (sine > 1e-9) return fromAxisAngle(scale(across, 1 / sine), Math.atan2(sine, cosine));
  if (cosine > 0) return [0, 0, 0, 1];
  const beside: Vector3 = Math.abs(from[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const axis = addScaled(beside, from, -dot(beside, from));
  return fromAxisAngle(scale(axis, 1 / norm(axis)), Math.PI);
}
