import type { Pose } from "../spatial/pose.ts";

/** A rigid motion as 12 numbers: a row-major rotation and a translation [m]. The form loops over triangles want. */
export type Rigid = Float64Array;
export const rigid = (): Rigid => Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0);

/** The same motion as a pose. */
export function rigidFromPose(pose: Pose, out: Rigid = rigid()): Rigid {
  const r = pose.quaternion;
  const x = r[0];
  const y = r[1];
  const z = r[2];
  const w = r[3];
  out[0] = 1 - 2 * (y * y + z * z);
  out[1] = 2 * (x * y - z * w);
  out[2] = 2 * (x * z + y * w);
  out[3] = 2 * (x * y + z * w);
  out[4] = 1 - 2 * (x * x + z * z);
  out[5] = 2 * (y * z - x * w);
  out[6] = 2 * (x * z - y * w);
  out[7] = 2 * (y * z + x * w);
  out[8] = 1 - 2 * (x * x + y * y);
  out[9] = pose.position[0];
  out[10] = pose.position[1];
  out[11] = pose.position[2];
  return out;
}

/** aFromB = worldFromA⁻¹ · worldFromB. `out` must be neither input. */
export function between(worldFromA: Rigid, worldFromB: Rigid, out: Rigid = rigid()): Rigid {
  const a = worldFromA;
  const b = worldFromB;
  const x = b[9]! - a[9]!;
  const y = b[10]! - a[10]!;
  const z = b[11]! - a[11]!;
  for (let r = 0; r < 3; r++) {
    const a0 = a[r]!;
    const a1 = a[3 + r]!;
    const a2 = a[6 + r]!;
    out[3 * r] = a0 * b[0]! + a1 * b[3]! + a2 * b[6]!;
    out[3 * r + 1] = a0 * b[1]! + a1 * b[4]! + a2 * b[7]!;
    out[3 * r + 2] = a0 * b[2]! + a1 * b[5]! + a2 * b[8]!;
    out[9 + r] = a0 * x + a1 * y + a2 * z;
  }
  return out;
}

/** Moves `count` points, 3 numbers each, from `points` at `from` into `out` at `to`. */
export function movePoints(
  motion: Rigid,
  points: Float64Array,
  from: number,
  count: number,
  out: Float64Array,
  to: number,
): void {
  const r0 = motion[0]!;
  const r1 = motion[1]!;
  const r2 = motion[2]!;
  const r3 = motion[3]!;
  const r4 = motion[4]!;
  const r5 = motion[5]!;
  const r6 = motion[6]!;
  const r7 = motion[7]!;
  const r8 = motion[8]!;
  const tx = motion[9]!;
  const ty = motion[10]!;
  const tz = motion[11]!;
  for (let i = 0; i < 3 * count; i += 3) {
    const x = points[from + i]!;
    const y = points[from + i + 1]!;
    const z = points[from + i + 2]!;
    out[to + i] = r0 * x + r1 * y + r2 * z + tx;
    out[to + i + 1] = r3 * x + r4 * y + r5 * z + ty;
    out[to + i + 2] = r6 * x + r7 * y + r8 * z + tz;
  }
}
