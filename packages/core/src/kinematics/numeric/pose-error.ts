import type { SerialArm } from "../../model/arm.ts";
import { slideOf } from "../../model/slide.ts";
import type { Pose } from "../../spatial/pose.ts";
import { norm } from "../../spatial/vector.ts";

/**
 * What is missing to a pose, in the base:
 *   out = ( p* − p ;  rotation vector of R* Rᵀ ), six numbers [m, rad]; the vector is 0 … π long.
 * It is the downhill direction of ½|p* − p|² + ½angle², seen by the tip. Allocates nothing.
 */
export function poseError(wanted: Pose, present: Pose, out: Float64Array): void {
  const p = present.position;
  const o = wanted.position;
  const q = present.quaternion;
  const r = wanted.quaternion;
  out[0] = o[0] - p[0];
  out[1] = o[1] - p[1];
  out[2] = o[2] - p[2];
  let x = -r[3] * q[0] + r[0] * q[3] - r[1] * q[2] + r[2] * q[1];
  let y = -r[3] * q[1] + r[0] * q[2] + r[1] * q[3] - r[2] * q[0];
  let z = -r[3] * q[2] - r[0] * q[1] + r[1] * q[0] + r[2] * q[3];
  const w = r[3] * q[3] + r[0] * q[0] + r[1] * q[1] + r[2] * q[2];
  const sine = Math.sqrt(x * x + y * y + z * z);
  const factor = (w < 0 ? -1 : 1) * (sine > 1e-12 ? (2 * Math.atan2(sine, Math.abs(w))) / sine : 2);
  x *= factor;
  y *= factor;
  z *= factor;
  out[3] = x;
  out[4] = y;
  out[5] = z;
}

/** Length of three numbers of a row of numbers. */
export const lengthAt = (v: Float64Array, at: number): number =>
  Math.sqrt(v[at]! * v[at]! + v[at + 1]! * v[at + 1]! + v[at + 2]! * v[at + 2]!);

/**
 * Sum of the lengths between the joint origins from joint 2 on, to the flange, and of all slides drawn out [m]: the
 * flange is never farther from joint 2 than this.
 */
export function lengthOfArm(arm: SerialArm): number {
  let sum = norm(arm.lastJointFromFlange.position) + slideOf(arm.joints.slice(1));
  for (let j = 1; j < arm.joints.length; j++) sum += norm(arm.joints[j]!.parentFromJoint.position);
  return sum;
}

/** Why these numbers are no pose, in one sentence; undefined for a pose. */
export function flawOfPose({ position, quaternion }: Pose): string | undefined {
  if (!position.every(Number.isFinite)) return "A coordinate of the pose is not a finite number.";
  const [x, y, z, w] = quaternion;
  const length = Math.sqrt(x * x + y * y + z * z + w * w);
  if (!(Math.abs(length - 1) < 1e-6))
    return `The quaternion of the pose has length ${length.toPrecision(4)}; a rotation has length 1.`;
  return undefined;
}
