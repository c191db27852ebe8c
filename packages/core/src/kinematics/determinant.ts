import type { SerialArm } from "../model/arm.ts";
import { jacobian } from "./jacobian.ts";

/**
 * Sign of the determinant of a six-joint arm's Jacobian: 1, −1, or 0 exactly on a singularity. It changes nowhere else.
 */
export function determinantSign(arm: SerialArm, q_rad: ArrayLike<number>, at = 0): number {
  const q = Float64Array.from({ length: 6 }, (_, j) => q_rad[at + j]!);
  const a = jacobian(arm, q);
  let sign = 1;
  for (let col = 0; col < 6; col++) {
    let pivot = col;
    for (let i = col + 1; i < 6; i++) if (Math.abs(a[i * 6 + col]!) > Math.abs(a[pivot * 6 + col]!)) pivot = i;
    if (a[pivot * 6 + col] === 0) return 0;
    if (pivot !== col) {
      sign = -sign;
      for (let j = col; j < 6; j++) {
        const swap = a[col * 6 + j]!;
        a[col * 6 + j] = a[pivot * 6 + j]!;
        a[pivot * 6 + j] = swap;
      }
    }
    if (a[col * 6 + col]! < 0) sign = -sign;
    for (let i = col + 1; i < 6; i++) {
      const factor = a[i * 6 + col]! / a[col * 6 + col]!;
      for (let j = col + 1; j < 6; j++) a[i * 6 + j]! -= factor * a[col * 6 + j]!;
    }
  }
  return sign;
}
