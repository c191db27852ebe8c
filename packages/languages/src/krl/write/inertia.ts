import { fromMatrix, toKukaAbc } from "@twincell/core";

/** Sweeps of Jacobi's method; three are enough for three by three. */
const SWEEPS = 12;

/**
 * Principal moments of an inertia [kg m²] and the turn of their axes:  I = R · diag(moments) · Rᵀ.  KUKA takes no
 * products of inertia. Cyclic Jacobi rotations; a diagonal inertia is left as it is.
 *
 * @param inertia  Ixx, Iyy, Izz, Ixy, Ixz, Iyz.
 */
export function principal(inertia: readonly [number, number, number, number, number, number]): {
  readonly moments: readonly number[];
  readonly abc_deg: readonly number[];
} {
  const [xx, yy, zz, xy, xz, yz] = inertia;
  const m = [xx, xy, xz, xy, yy, yz, xz, yz, zz];
  const r = [1, 0, 0, 0, 1, 0, 0, 0, 1];
  for (let sweep = 0; sweep < SWEEPS; sweep++)
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ] as const)
      rotate(m, r, p, q);
  return { moments: [m[0]!, m[4]!, m[8]!], abc_deg: toKukaAbc(fromMatrix(r)) };
}

/** Turns axes p and q so that their product vanishes. */
function rotate(m: number[], r: number[], p: number, q: number): void {
  const product = m[3 * p + q]!;
  if (Math.abs(product) < 1e-300) return;
  const angle = Math.atan2(2 * product, m[4 * q]! - m[4 * p]!) / 2;
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  for (const [matrix, across] of [
    [m, true],
    [m, false],
    [r, true],
  ] as const) {
    for (let i = 0; i < 3; i++) {
      const a = across ? 3 * i + p : 3 * p + i;
      const b = across ? 3 * i + q : 3 * q + i;
      const x = matrix[a]!;
      const y = matrix[b]!;
      matrix[a] = c * x - s * y;
      matrix[b] = s * x + c * y;
    }
  }
}
