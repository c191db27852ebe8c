import { fromMatrix, type Pose } from "@twincell/core";

/** Six numbers of a controller pose: metres, and a rotation vector in radians. */
export type Six = readonly [number, number, number, number, number, number];
/** A pose as a matrix: nine numbers row by row, and the origin [m]. */
export interface Matrix {
  readonly r: readonly number[];
  readonly p: readonly [number, number, number];
}

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

/** a·b */
export function times(a: Matrix, b: Matrix): Matrix {
  const r: number[] = [];
  for (let i = 0; i < 9; i += 3)
    for (let j = 0; j < 3; j++) r.push(a.r[i]! * b.r[j]! + a.r[i + 1]! * b.r[3 + j]! + a.r[i + 2]! * b.r[6 + j]!);
  const along = (row: number): number => a.r[row]! * b.p[0] + a.r[row + 1]! * b.p[1] + a.r[row + 2]! * b.p[2];
  return { r, p: [a.p[0] + along(0), a.p[1] + along(3), a.p[2] + along(6)] };
}

export function inverted({ r, p }: Matrix): Matrix {
  const back = (column: number): number => -(r[column]! * p[0] + r[column + 3]! * p[1] + r[column + 6]! * p[2]);
  return { r: [r[0]!, r[3]!, r[6]!, r[1]!, r[4]!, r[7]!, r[2]!, r[5]!, r[8]!], p: [back(0), back(1), back(2)] };
}

/** As a quaternion, for the rest of the world. */
export const toPose = <Into extends string = string, From extends string = string>({
  r,
  p,
}: Matrix): Pose<Into, From> => ({ position: [...p], quaternion: fromMatrix(r) });

export function fromPose({ position, quaternion: [x, y, z, w] }: Pose): Matrix {
  return {
    // biome-ignore format: table of numbers
    r: [
      1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
      2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
      2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y),
    ],
    p: [...position],
  };
}

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
