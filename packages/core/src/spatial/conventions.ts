import type { Pose } from "./pose.ts";
import { normalizeQuaternion, type Quaternion } from "./quaternion.ts";
import { fromEulerAngles, toEulerAngles } from "./turns.ts";
import { degrees, radians } from "./units.ts";
import type { Vector3 } from "./vector.ts";

// Every orientation format by its vendor's name: one equation each, degrees where the vendor writes degrees.
// R maps axes of the described frame to the frame it is described in. Held against one file of 47 poses in all formats.

/** Three angles as a vendor prints them [deg]. */
export type Angles_deg = Vector3;

/** KUKA: A, B, C.  R = Rz(A) · Ry(B) · Rx(C). */
export const fromKukaAbc = (a_deg: number, b_deg: number, c_deg: number, out: Quaternion = [0, 0, 0, 1]): Quaternion =>
  fromEulerAngles("zyx", radians(a_deg), radians(b_deg), radians(c_deg), out);
/** KUKA: A, C in (−180, 180], B in [−90, 90]; at B = ±90 C is 0. */
export const toKukaAbc = (q: Quaternion, out: Angles_deg = [0, 0, 0]): Angles_deg =>
  inDegrees(toEulerAngles("zyx", q, out));

/** FANUC: W, P, R.  R = Rz(R) · Ry(P) · Rx(W). */
export const fromFanucWpr = (w_deg: number, p_deg: number, r_deg: number, out: Quaternion = [0, 0, 0, 1]): Quaternion =>
  fromKukaAbc(r_deg, p_deg, w_deg, out);
/** FANUC: W, R in (−180, 180], P in [−90, 90]; at P = ±90 W is 0. */
export const toFanucWpr = (q: Quaternion, out: Angles_deg = [0, 0, 0]): Angles_deg => swapEnds(toKukaAbc(q, out));

/** Yaskawa: Rx, Ry, Rz about fixed axes.  R = Rz(Rz) · Ry(Ry) · Rx(Rx). */
export const fromYaskawaRxyz = (
  rx_deg: number,
  ry_deg: number,
  rz_deg: number,
  out: Quaternion = [0, 0, 0, 1],
): Quaternion => fromKukaAbc(rz_deg, ry_deg, rx_deg, out);
/** Yaskawa: Rx, Rz in (−180, 180], Ry in [−90, 90]; at Ry = ±90 Rx is 0. */
export const toYaskawaRxyz = (q: Quaternion, out: Angles_deg = [0, 0, 0]): Angles_deg => swapEnds(toKukaAbc(q, out));

/** V+: yaw, pitch, roll.  R = Rz(yaw) · Ry(pitch) · Rz(roll). */
export const fromVplusYpr = (
  yaw_deg: number,
  pitch_deg: number,
  roll_deg: number,
  out: Quaternion = [0, 0, 0, 1],
): Quaternion => fromEulerAngles("zyz", radians(yaw_deg), radians(pitch_deg), radians(roll_deg), out);
/** V+: yaw, roll in (−180, 180], pitch in [0, 180]; at pitch 0 and 180 roll is 0. */
export const toVplusYpr = (q: Quaternion, out: Angles_deg = [0, 0, 0]): Angles_deg =>
  inDegrees(toEulerAngles("zyz", q, out));

/** VAL 3: rx, ry, rz about the turned axes.  R = Rx(rx) · Ry(ry) · Rz(rz). */
export const fromVal3 = (rx_deg: number, ry_deg: number, rz_deg: number, out: Quaternion = [0, 0, 0, 1]): Quaternion =>
  fromEulerAngles("xyz", radians(rx_deg), radians(ry_deg), radians(rz_deg), out);
/** VAL 3: rx, rz in (−180, 180], ry in [−90, 90]; at ry = ±90 rz is 0. */
export const toVal3 = (q: Quaternion, out: Angles_deg = [0, 0, 0]): Angles_deg =>
  inDegrees(toEulerAngles("xyz", q, out));

/** ABB: q1 … q4 = w, x, y, z. Brought to length 1, as digits of a printed quaternion are cut. */
export function fromAbbQuaternion(
  q1: number,
  q2: number,
  q3: number,
  q4: number,
  out: Quaternion = [0, 0, 0, 1],
): Quaternion {
  out[0] = q2;
  out[1] = q3;
  out[2] = q4;
  out[3] = q1;
  return normalizeQuaternion(out, out);
}
/** ABB: q1 … q4 = w, x, y, z with q1 ≥ 0. */
export function toAbbQuaternion(
  q: Quaternion,
  out: [number, number, number, number] = [1, 0, 0, 0],
): [number, number, number, number] {
  const sign = q[3] < 0 ? -1 : 1;
  const x = q[0];
  const y = q[1];
  const z = q[2];
  out[0] = sign * q[3];
  out[1] = sign * x;
  out[2] = sign * y;
  out[3] = sign * z;
  return out;
}

/** Universal Robots: rotation vector [rad], direction = axis, length = angle.  R = exp([r]×). */
export function fromUrVector(
  rx_rad: number,
  ry_rad: number,
  rz_rad: number,
  out: Quaternion = [0, 0, 0, 1],
): Quaternion {
  const angle = Math.sqrt(rx_rad * rx_rad + ry_rad * ry_rad + rz_rad * rz_rad);
  const s = angle > 1e-12 ? Math.sin(angle / 2) / angle : 0.5;
  out[0] = rx_rad * s;
  out[1] = ry_rad * s;
  out[2] = rz_rad * s;
  out[3] = Math.cos(angle / 2);
  return out;
}
/** Universal Robots: rotation vector [rad] of length 0 … π. */
export function toUrVector(q: Quaternion, out: Vector3 = [0, 0, 0]): Vector3 {
  const sign = q[3] < 0 ? -1 : 1;
  const sine = Math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
  const factor = sine > 1e-12 ? (2 * sign * Math.atan2(sine, sign * q[3])) / sine : 2 * sign;
  out[0] = q[0] * factor;
  out[1] = q[1] * factor;
  out[2] = q[2] * factor;
  return out;
}

/** The edge-tracing paper (row N-12): a_x, a_y, a_z [deg].  R = Rz(a_z) · Ry(a_y) · Rx(a_x). */
export const fromPaperXyz = (
  ax_deg: number,
  ay_deg: number,
  az_deg: number,
  out: Quaternion = [0, 0, 0, 1],
): Quaternion => fromKukaAbc(az_deg, ay_deg, ax_deg, out);

/**
 * Unity's inspector: turns about z, then x, then y, all of the world [deg], left-handed.
 *   R_unity = Ry(y) · Rx(x) · Rz(z) (row L-23).
 */
export const fromUnityAngles = (
  x_deg: number,
  y_deg: number,
  z_deg: number,
  out: Quaternion = [0, 0, 0, 1],
): Quaternion => fromEulerAngles("yxz", radians(y_deg), radians(x_deg), radians(z_deg), out);

/**
 * Unity's left-handed axes to the robot's (rows N-20, N-22, golden G-12):
 *   S = [−x, −z, y], det S = −1, S (1, 2, 3) = (−1, −3, 2).
 * Positions: S p. Orientations: S R Sᵀ, for a quaternion u → det(S) · S u = (x, z, −y) with w as it is.
 */
export function fromUnity(unity: Pose, out: Pose): Pose {
  const [x, y, z] = unity.position;
  const [qx, qy, qz, qw] = unity.quaternion;
  out.position[0] = -x;
  out.position[1] = -z;
  out.position[2] = y;
  out.quaternion[0] = qx;
  out.quaternion[1] = qz;
  out.quaternion[2] = -qy;
  out.quaternion[3] = qw;
  return out;
}
/** The robot's axes to Unity's: Sᵀ p and Sᵀ R S. Undoes `fromUnity`. */
export function toUnity(real: Pose, out: Pose): Pose {
  const [x, y, z] = real.position;
  const [qx, qy, qz, qw] = real.quaternion;
  out.position[0] = -x;
  out.position[1] = z;
  out.position[2] = -y;
  out.quaternion[0] = qx;
  out.quaternion[1] = -qz;
  out.quaternion[2] = qy;
  out.quaternion[3] = qw;
  return out;
}

function inDegrees(angles: Vector3): Angles_deg {
  angles[0] = degrees(angles[0]);
  angles[1] = degrees(angles[1]);
  angles[2] = degrees(angles[2]);
  return angles;
}
function swapEnds(angles: Vector3): Vector3 {
  const first = angles[0];
  angles[0] = angles[2];
  angles[2] = first;
  return angles;
}
