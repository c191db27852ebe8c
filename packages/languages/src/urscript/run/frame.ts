import { fromMatrix, type Pose } from "@twincell/core";
import { rotationRows, times, type Matrix } from "../../parser/index.ts";

/** Six numbers of a controller pose: metres, and a rotation vector in radians. */
export type Six = readonly [number, number, number, number, number, number];

/** Rodrigues:  R = I cos θ + (1 − cos θ) k kᵀ + sin θ [k]×,  θ = |r|, k = r / θ. */
export function matrixOf([x, y, z, rx, ry, rz]: Six): Matrix {
  const angle = Math.hypot(rx, ry, rz);
  if (angle < 1e-12) return { r: [1, -rz, ry, rz, 1, -rx, -ry, rx, 1], p: [x, y, z] };
  const a = rx / angle;
  const b = ry / angle;
  const c = rz / angle;
  const cos = Math.cos(angle);
  const sin = Math.sin(angle);
  const v = 1 - cos;
  return {
    r: [
      cos + a * a * v,
      a * b * v - c * sin,
      a * c * v + b * sin,
      a * b * v + c * sin,
      cos + b * b * v,
      b * c * v - a * sin,
      a * c * v - b * sin,
      b * c * v + a * sin,
      cos + c * c * v,
    ],
    p: [x, y, z],
  };
}

/** The rotation vector of a matrix, of length 0 … π. */
export function sixOf({ r, p }: Matrix): Six {
  const x = r[7]! - r[5]!;
  const y = r[2]! - r[6]!;
  const z = r[3]! - r[1]!;
  const sine = Math.hypot(x, y, z) / 2;
  const cosine = (r[0]! + r[4]! + r[8]! - 1) / 2;
  const angle = Math.atan2(sine, cosine);
  if (sine > 1e-6) {
    const k = angle / (2 * sine);
    return [...p, x * k, y * k, z * k];
  }
  if (cosine > 0) return [...p, x / 2, y / 2, z / 2];
  // Half a turn: R = 2 k kᵀ − I, so the largest diagonal element says most about the axis.
  const squares = [r[0]!, r[4]!, r[8]!].map(diagonal => Math.max(0, (diagonal + 1) / 2));
  const largest = squares.indexOf(Math.max(...squares));
  const axis = [0, 1, 2].map(i =>
    i === largest
      ? Math.sqrt(squares[largest]!)
      : (r[3 * i + largest]! + r[3 * largest + i]!) / (4 * Math.sqrt(squares[largest]!)),
  );
  const turned = axis[0]! * x + axis[1]! * y + axis[2]! * z < 0 ? -angle : angle;
  return [...p, axis[0]! * turned, axis[1]! * turned, axis[2]! * turned];
}

/** As a quaternion, for the rest of the world. */
export const toPose = <Into extends string = string, From extends string = string>({
  r,
  p,
}: Matrix): Pose<Into, From> => ({ position: [...p], quaternion: fromMatrix(r) });

export const fromPose = ({ position, quaternion }: Pose): Matrix => ({
  r: rotationRows(quaternion),
  p: [...position],
});

/** rpy2rotvec:  R = Rz(yaw) · Ry(pitch) · Rx(roll). */
export function fromRollPitchYaw(roll: number, pitch: number, yaw: number): Matrix {
  const about = (x: number, y: number, z: number): Matrix => matrixOf([0, 0, 0, x, y, z]);
  return times(times(about(0, 0, yaw), about(0, pitch, 0)), about(roll, 0, 0));
}

/** Roll, pitch, yaw of a matrix; at pitch ±90° roll is 0. */
export function toRollPitchYaw({ r }: Matrix): [roll: number, pitch: number, yaw: number] {
  const flat = Math.hypot(r[0]!, r[3]!);
  const pitch = Math.atan2(-r[6]!, flat);
  return flat < 1e-9
    ? [0, pitch, Math.atan2(-r[1]!, r[4]!)]
    : [Math.atan2(r[7]!, r[8]!), pitch, Math.atan2(r[3]!, r[0]!)];
}
