import type { SerialArm } from "../model/arm.ts";
import { identity, type Pose } from "../spatial/pose.ts";
import { rotate } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { armScratch, chainOf, walk, type ArmScratch } from "./chain.ts";

/** Working memory of `jacobian`: one per caller. */
export interface JacobianScratch {
  readonly arm: ArmScratch;
  /** Axis and origin of every joint in the base, six numbers each. */
  readonly axes: Float64Array;
  readonly baseFromFlange: Pose<"base", "flange">;
  readonly tip: Vector3;
}
export const jacobianScratch = (joints = 6): JacobianScratch => ({
  arm: armScratch(),
  axes: new Float64Array(6 * joints),
  baseFromFlange: identity(),
  tip: [0, 0, 0],
});

/**
 * Geometric Jacobian of the tool tip in the robot base: joint speeds to speed of the tip [m/s] and turning rate
 * [rad/s].
 *
 *   column i = ( z_i × (tip − o_i) ; z_i ),   z_i axis and o_i origin of joint i in the base;   ( z_i ; 0 ) of a slide
 *
 * @param arm            n joints. Read only.
 * @param q              n joint values [rad; m of a slide].
 * @param flangeFromTip  the tip seen in the flange [m]; the flange itself when null.
 * @param out            6 n numbers, row major: three rows of speed, three of turning rate. Returned.
 * @param scratch        made for n joints; afterwards it also holds `baseFromFlange`. With it and `out` the call
 *   allocates nothing.
 * @throws {JointCountFault} when q does not hold n values.
 * @see Lynch & Park, Modern Robotics, Cambridge 2017, ch. 5.1.
 */
export function jacobian(
  arm: SerialArm,
  q: ArrayLike<number>,
  flangeFromTip: Vector3 | null = null,
  out: Float64Array = new Float64Array(6 * arm.joints.length),
  scratch: JacobianScratch = jacobianScratch(arm.joints.length),
): Float64Array {
  const n = arm.joints.length;
  const axes = scratch.axes;
  const flange = scratch.baseFromFlange;
  const tip = scratch.tip;
  walk(chainOf(arm, q, scratch.arm), q, flange, null, axes);
  if (flangeFromTip === null) {
    tip[0] = 0;
    tip[1] = 0;
    tip[2] = 0;
  } else rotate(flange.quaternion, flangeFromTip, tip);
  const px = flange.position[0] + tip[0];
  const py = flange.position[1] + tip[1];
  const pz = flange.position[2] + tip[2];
  for (let i = 0; i < n; i++) {
    const at = 6 * i;
    const zx = axes[at]!;
    const zy = axes[at + 1]!;
    const zz = axes[at + 2]!;
    const rx = px - axes[at + 3]!;
    const ry = py - axes[at + 4]!;
    const rz = pz - axes[at + 5]!;
    out[i] = zy * rz - zz * ry;
    out[n + i] = zz * rx - zx * rz;
    out[2 * n + i] = zx * ry - zy * rx;
    out[3 * n + i] = zx;
    out[4 * n + i] = zy;
    out[5 * n + i] = zz;
  }
  const slides = scratch.arm.slides;
  for (let k = 0; k < slides.length; k++) {
    for (let row = 0, i = slides[k]!; row < 3; row++) {
      out[row * n + i] = axes[6 * i + row]!;
      out[(3 + row) * n + i] = 0;
    }
  }
  return out;
}

/** What the hand feels: the tip's speed [m/s] and turning rate [rad/s] at joint speeds, six numbers: J · q̇. */
export function tipTwist(
  jacobianRows: Float64Array,
  speeds_rad_s: ArrayLike<number>,
  out: Float64Array = new Float64Array(6),
): Float64Array {
  const n = jacobianRows.length / 6;
  for (let row = 0; row < 6; row++) {
    let sum = 0;
    for (let i = 0; i < n; i++) sum += jacobianRows[row * n + i]! * speeds_rad_s[i]!;
    out[row] = sum;
  }
  return out;
}
