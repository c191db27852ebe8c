import type { SerialArm } from "../robots/arm.ts";
import { compose, identity, transformPoint, type Pose } from "../spatial/pose.ts";
import { rotate } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { linkPoses, type ArmScratch, armScratch } from "./forward.ts";

/** Working memory of `jacobian`: one per caller and arm. */
export interface JacobianScratch { readonly arm: ArmScratch; readonly links: readonly Pose<"base", "link">[]; readonly flange: Pose<"base", "flange">; readonly axis: Vector3; readonly point: Vector3 }
export const jacobianScratch = (joints = 6): JacobianScratch =>
  ({ arm: armScratch(), links: Array.from({ length: joints + 1 }, () => identity()), flange: identity(), axis: [0, 0, 0], point: [0, 0, 0] });

/**
 * Geometric Jacobian of a point fixed to the flange.
 *
 *   ( v, ω ) = J q̇,   column i = ( a_i × (p − o_i), a_i ),   a_i, o_i = axis and origin of joint i in the base
 *
 * @param flangePoint  the point seen from the flange [m]; [0, 0, 0] is the flange itself.
 * @param out          6 × n, row-major: three rows of m/s, three of rad/s per rad/s. Returned.
 * @param scratch      with it the call allocates nothing; afterwards `scratch.flange` is the pose of the flange.
 * @see Lynch & Park, Modern Robotics, Cambridge 2017, ch. 5.
 */
export function jacobian(arm: SerialArm, q: ArrayLike<number>, flangePoint: Vector3, out: Float64Array, scratch: JacobianScratch = jacobianScratch(arm.joints.length)): Float64Array {
  const n = arm.joints.length, { links, flange, axis, point } = scratch;
  linkPoses(arm, q, links, scratch.arm);
  compose(links[n]! as Pose, arm.lastJointFromFlange as Pose, flange as Pose);
  transformPoint(flange, flangePoint, point);
  for (let i = 0; i < n; i++) {
    const link = links[i + 1]!;
    rotate(link.quaternion, arm.joints[i]!.axis, axis);
    const x = point[0] - link.position[0], y = point[1] - link.position[1], z = point[2] - link.position[2];
    out[i] = axis[1] * z - axis[2] * y;
    out[n + i] = axis[2] * x - axis[0] * z;
    out[2 * n + i] = axis[0] * y - axis[1] * x;
    out[3 * n + i] = axis[0]; out[4 * n + i] = axis[1]; out[5 * n + i] = axis[2];
  }
  return out;
}
