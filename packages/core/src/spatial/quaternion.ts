import type { Vector3 } from "./vector.ts";

/** Unit quaternion x, y, z, w. q and −q are the same rotation. */
export type Quaternion = [number, number, number, number];

/** Row-major 3 × 3 rotation: columns are the axes of the rotated frame seen in the frame rotated into. */
export type Matrix3 = [number, number, number, number, number, number, number, number, number];

/** out = a · b (Hamilton): first b, then a. `out` may be either input. */
export function multiply(a: Quaternion, b: Quaternion, out: Quaternion = [0, 0, 0, 1]): Quaternion {
  const ax = a[0];
  const ay = a[1];
  const az = a[2];
  const aw = a[3];
  const bx = b[0];
  const by = b[1];
  const bz = b[2];
  const bw = b[3];
  out[0] = aw * bx + ax * bw + ay * bz - az * by;
  out[1] = aw * by - ax * bz + ay * bw + az * bx;
  out[2] = aw * bz + ax * by - ay * bx + az * bw;
  out[3] = aw * bw - ax * bx - ay * by - az * bz;
  return out;
}

/** out = q⁻¹ of a unit quaternion. `out` may be `q`. */
export function conjugate(q: Quaternion, out: Quaternion = [0, 0, 0, 1]): Quaternion {
  out[0] = -q[0];
  out[1] = -q[1];
  out[2] = -q[2];
  out[3] = q[3];
  return out;
}

/** out = R(q) · v = v + 2 u × (u × v + w v), u = (x, y, z). `out` may be `v`. */
export function rotate(q: Quaternion, v: Vector3, out: Vector3 = [0, 0, 0]): Vector3 {
  const x = q[0];
  const y = q[1];
  const z = q[2];
  const w = q[3];
  const vx = v[0];
  const vy = v[1];
  const vz = v[2];
  const tx = 2 * (y * vz - z * vy);
  const ty = 2 * (z * vx - x * vz);
  const tz = 2 * (x * vy - y * vx);
  out[0] = vx + w * tx + y * tz - z * ty;
  out[1] = vy + w * ty + z * tx - x * tz;
  out[2] = vz + w * tz + x * ty - y * tx;
  return out;
}

/** Rotation by `angle_rad` about the unit vector `axis`. */
export function fromAxisAngle(axis: Vector3, angle_rad: number, out: Quaternion = [0, 0, 0, 1]): Quaternion {
  const half = angle_rad / 2;
  const s = Math.sin(half);
  out[0] = axis[0] * s;
  out[1] = axis[1] * s;
  out[2] = axis[2] * s;
  out[3] = Math.cos(half);
  return out;
}

/** out = q / |q|. A quaternion of length 0 becomes the identity. `out` may be `q`. */
export function normalizeQuaternion(q: Quaternion, out: Quaternion = [0, 0, 0, 1]): Quaternion {
  const n = Math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (n < 1e-300) {
    out[0] = out[1] = out[2] = 0;
    out[3] = 1;
    return out;
  }
  out[0] = q[0] / n;
  out[1] = q[1] / n;
  out[2] = q[2] / n;
  out[3] = q[3] / n;
  return out;
}

/** Rotation matrix of a unit quaternion. */
export function toMatrix(q: Quaternion, out: Matrix3 = [1, 0, 0, 0, 1, 0, 0, 0, 1]): Matrix3 {
  const x = q[0];
  const y = q[1];
  const z = q[2];
  const w = q[3];
  out[0] = 1 - 2 * (y * y + z * z);
  out[1] = 2 * (x * y - z * w);
  out[2] = 2 * (x * z + y * w);
  out[3] = 2 * (x * y + z * w);
  out[4] = 1 - 2 * (x * x + z * z);
  out[5] = 2 * (y * z - x * w);
  out[6] = 2 * (x * z - y * w);
  out[7] = 2 * (y * z + x * w);
  out[8] = 1 - 2 * (x * x + y * y);
  return out;
}

/** Unit quaternion of a rotation matrix (Shepperd: the largest of w, x, y, z is the pivot). w ≥ 0. */
export function fromMatrix(m: ArrayLike<number>, out: Quaternion = [0, 0, 0, 1]): Quaternion {
  const m00 = m[0]!;
  const m11 = m[4]!;
  const m22 = m[8]!;
  const trace = m00 + m11 + m22;
  if (trace > m00 && trace > m11 && trace > m22) {
    out[0] = m[7]! - m[5]!;
    out[1] = m[2]! - m[6]!;
    out[2] = m[3]! - m[1]!;
    out[3] = 1 + trace;
  } else if (m00 > m11 && m00 > m22) {
    out[0] = 1 + m00 - m11 - m22;
    out[1] = m[1]! + m[3]!;
    out[2] = m[2]! + m[6]!;
    out[3] = m[7]! - m[5]!;
  } else if (m11 > m22) {
    out[0] = m[1]! + m[3]!;
    out[1] = 1 + m11 - m00 - m22;
    out[2] = m[5]! + m[7]!;
    out[3] = m[2]! - m[6]!;
  } else {
    out[0] = m[2]! + m[6]!;
    out[1] = m[5]! + m[7]!;
    out[2] = 1 + m22 - m00 - m11;
    out[3] = m[3]! - m[1]!;
  }
  normalizeQuaternion(out, out);
  if (out[3] < 0) {
    out[0] = -out[0];
    out[1] = -out[1];
    out[2] = -out[2];
    out[3] = -out[3];
  }
  return out;
}

/** Angle between two orientations [rad], 0 … π: 2 atan2(|u|, |w|) of a⁻¹ b, exact near 0 as well. */
export function angleBetween(a: Quaternion, b: Quaternion): number {
  const x = a[3] * b[0] - a[0] * b[3] - a[1] * b[2] + a[2] * b[1];
  const y = a[3] * b[1] + a[0] * b[2] - a[1] * b[3] - a[2] * b[0];
  const z = a[3] * b[2] - a[0] * b[1] + a[1] * b[0] - a[2] * b[3];
  const w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  return 2 * Math.atan2(Math.sqrt(x * x + y * y + z * z), Math.abs(w));
}

/** Shortest great-circle interpolation at constant angular speed; t in [0, 1]. `out` may be either input. */
export function slerp(a: Quaternion, b: Quaternion, t: number, out: Quaternion = [0, 0, 0, 1]): Quaternion {
  const cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const sign = cosine < 0 ? -1 : 1;
  const theta = angleBetween(a, b) / 2;
  const sine = Math.sin(theta);
  const wa = sine > 1e-9 ? Math.sin((1 - t) * theta) / sine : 1 - t;
  const wb = (sine > 1e-9 ? Math.sin(t * theta) / sine : t) * sign;
  out[0] = a[0] * wa + b[0] * wb;
  out[1] = a[1] * wa + b[1] * wb;
  out[2] = a[2] * wa + b[2] * wb;
  out[3] = a[3] * wa + b[3] * wb;
  return normalizeQuaternion(out, out);
}
