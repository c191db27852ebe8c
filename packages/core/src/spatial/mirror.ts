import type { Pose } from "./pose.ts";
import { identity } from "./pose.ts";

/** The one axis that points the other way in the other hand's frame. */
export type FlippedAxis = "x" | "y" | "z";

/**
 * The same place seen from a frame of the other hand whose axes match this one's except one, which points the other way
 * (row L-22):  p ← S p,  R ← S R S,  S = diag with −1 at the flipped axis, det S = −1.  Undoes itself.
 *
 * A turn about the flipped axis keeps its sign, turns about the two others change theirs (row L-73): a clockwise angle
 * about an axis of a left-handed frame is a counter-clockwise one about its image.
 *
 * @param out  may be `seen`.
 */
export function toOtherHand(flipped: FlippedAxis, seen: Pose, out: Pose = identity()): Pose {
  const axis = flipped === "x" ? 0 : flipped === "y" ? 1 : 2;
  for (let i = 0; i < 3; i++) {
    const sign = i === axis ? -1 : 1;
    out.position[i] = sign * seen.position[i]!;
    out.quaternion[i] = -sign * seen.quaternion[i]!;
  }
  out.quaternion[3] = seen.quaternion[3];
  return out;
}
