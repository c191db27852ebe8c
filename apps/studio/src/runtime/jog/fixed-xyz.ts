import type { Quaternion } from "@twincell/core";

/**
 * Rx, Ry, Rz of the read-outs: turns about the fixed axes x, then y, then z.
 *
 *   R = Rz(rz) · Ry(ry) · Rx(rx),   |ry| ≤ π/2
 *
 * Where ry = ±π/2 only rx ∓ rz is determined; rx takes all of it and rz is 0. `out` receives rx, ry, rz [rad].
 */
export function fixedXyz(q: Quaternion, out: Float64Array): Float64Array {
  const x = q[0];
  const y = q[1];
  const z = q[2];
  const w = q[3];
  const sine = 2 * (w * y - x * z);
  if (Math.abs(sine) > 1 - 1e-12) {
    out[0] = Math.sign(sine) * 2 * Math.atan2(z, w) * -1;
    out[1] = (Math.sign(sine) * Math.PI) / 2;
    out[2] = 0;
    out[0] = wrap(out[0]!);
    return out;
  }
  out[0] = Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y));
  out[1] = Math.asin(sine);
  out[2] = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  return out;
}
/** The rotation of those angles. */
export function fromFixedXyz(rx: number, ry: number, rz: number, out: Quaternion = [0, 0, 0, 1]): Quaternion {
  const cx = Math.cos(rx / 2);
  const sx = Math.sin(rx / 2);
  const cy = Math.cos(ry / 2);
  const sy = Math.sin(ry / 2);
  const cz = Math.cos(rz / 2);
  const sz = Math.sin(rz / 2);
  out[0] = sx * cy * cz - cx * sy * sz;
  out[1] = cx * sy * cz + sx * cy * sz;
  out[2] = cx * cy * sz - sx * sy * cz;
  out[3] = cx * cy * cz + sx * sy * sz;
  return out;
}
const wrap = (angle: number): number =>
  angle > Math.PI ? angle - 2 * Math.PI : angle <= -Math.PI ? angle + 2 * Math.PI : angle;
