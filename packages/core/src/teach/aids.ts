import type { Pose } from "../spatial/pose.ts";
import {
  fromAxisAngle,
  fromMatrix,
  multiply,
  normalizeQuaternion,
  rotate,
  type Quaternion,
} from "../spatial/quaternion.ts";
import { cross, dot, norm, normalize, type Vector3 } from "../spatial/vector.ts";

/**
 * One direction for each top edge of a box-like piece, counter-clockwise from above, from the edge on its +x side (row
 * N-52).
 */
export const ORIENTATION_PRESET_COUNT = 4;

const SQUARE_ROOT_HALF = Math.SQRT1_2;
/** Outward normals of the four sides in the piece's frame, z up. */
const OUTWARD: readonly Vector3[] = [
  [1, 0, 0],
  [0, 1, 0],
  [-1, 0, 0],
  [0, -1, 0],
];

/** The aid after (+1) or before (−1) that one, round and round. */
export const nextOrientationPreset = (index: number, step: 1 | -1): number =>
  (((index + step) % ORIENTATION_PRESET_COUNT) + ORIENTATION_PRESET_COUNT) % ORIENTATION_PRESET_COUNT;

/** Tool axis of an aid in the world: 45° down and inward across the edge, square to it. Unit vector. */
export function orientationPresetAxis(
  worldFromObject: Pose<"world", "object">,
  index: number,
  out: Vector3 = [0, 0, 0],
): Vector3 {
  const n = OUTWARD[nextOrientationPreset(index - 1, 1)]!;
  out[0] = -n[0] * SQUARE_ROOT_HALF;
  out[1] = -n[1] * SQUARE_ROOT_HALF;
  out[2] = -SQUARE_ROOT_HALF;
  return rotate(worldFromObject.quaternion, out, out);
}

/**
 * Orientation of the tool tip for an aid: 45° to the top, 45° to the side, 90° to the edge (row N-52).
 *
 * Without `near`, tcp z = aid axis and tcp x runs along the edge, counter-clockwise from above. With it, tcp z is the
 * same and the turn about it is the one reached from `near` by the shortest rotation: a tool that is round does not
 * care, the wrist does.
 *
 * @param worldFromObject  piece with z up. Read only.
 * @param near             present orientation of the tip in the world.
 */
export function orientationPreset(
  worldFromObject: Pose<"world", "object">,
  index: number,
  near?: Quaternion,
  out: Quaternion = [0, 0, 0, 1],
): Quaternion {
  const axis = orientationPresetAxis(worldFromObject, index);
  if (near !== undefined) return alignToolAxis(near, axis, out);
  const n = OUTWARD[nextOrientationPreset(index - 1, 1)]!;
  const along = rotate(worldFromObject.quaternion, [-n[1], n[0], 0]);
  const side = cross(axis, along);
  return fromMatrix([along[0], side[0], axis[0], along[1], side[1], axis[1], along[2], side[2], axis[2]], out);
}

/**
 * The orientation with tool axis (tcp z) along `axis` that is turned least from the present one:
 * the turn by ∠(z, axis) about z × axis; where the two are opposite, half a turn about tcp x.
 *
 * @param axis  unit vector in the world.
 * @param out   may be `present`.
 */
export function alignToolAxis(present: Quaternion, axis: Vector3, out: Quaternion = [0, 0, 0, 1]): Quaternion {
  const z = rotate(present, [0, 0, 1]);
  const across = cross(z, axis);
  const sine = norm(across);
  const about = sine > 1e-12 ? normalize(across) : rotate(present, [1, 0, 0]);
  const turn = fromAxisAngle(about, Math.atan2(sine, dot(z, axis)));
  return normalizeQuaternion(multiply(turn, present, out), out);
}
