const MOST_SWEEPS = 50;

/** Eigenvalues of a symmetric matrix, largest first, and their unit eigenvectors, one row each in the same order. */
export interface Eigen {
  readonly values: Float64Array;
  readonly vectors: readonly Float64Array[];
}

/**
 * A = Σ λ v vᵀ of a symmetric n × n matrix by cyclic Jacobi rotations.
 *
 * @param matrix  n² numbers, row major, symmetric, finite. Read only.
 * @see Golub & Van Loan, Matrix Computations, 4th ed., 8.5.
 */
export function symmetricEigen(matrix: ArrayLike<number>): Eigen {
  const n = Math.round(Math.sqrt(matrix.length));
  const a = Float64Array.from(matrix);
  const v = new Float64Array(n * n);
  for (let i = 0; i < n; i++) v[i * n + i] = 1;
  for (let sweep = 0; sweep < MOST_SWEEPS; sweep++) {
    let off = 0;
    let on = 0;
    for (let i = 0; i < n; i++)
      for (let j = 0; j < n; j++)
        if (i === j) on += a[i * n + j]! ** 2;
        else off += a[i * n + j]! ** 2;
    if (off <= 1e-32 * on) break;
    for (let p = 0; p < n - 1; p++) for (let q = p + 1; q < n; q++) rotateAway(a, v, n, p, q);
  }
  const order = Array.from({ length: n }, (_, i) => i).sort((i, j) => a[j * n + j]! - a[i * n + i]!);
  return {
    values: Float64Array.from(order, i => a[i * n + i]!),
    vectors: order.map(column => Float64Array.from({ length: n }, (_, row) => v[row * n + column]!)),
  };
}

/** a ← JᵀaJ, v ← vJ with the rotation J in the plane of p and q that makes a[p, q] zero. */
function rotateAway(a: Float64Array, v: Float64Array, n: number, p: number, q: number): void {
  const apq = a[p * n + q]!;
  if (apq === 0) return;
  const zeta = (a[q * n + q]! - a[p * n + p]!) / (2 * apq);
  const t = (zeta < 0 ? -1 : 1) / (Math.abs(zeta) + Math.sqrt(1 + zeta * zeta));
  const c = 1 / Math.sqrt(1 + t * t);
  const s = t * c;
  for (let k = 0; k < n; k++) {
    const x = a[k * n + p]!;
    const y = a[k * n + q]!;
    a[k * n + p] = c * x - s * y;
    a[k * n + q] = s * x + c * y;
  }
  for (let k = 0; k < n; k++) {
    const x = a[p * n + k]!;
    const y = a[q * n + k]!;
    a[p * n + k] = c * x - s * y;
    a[q * n + k] = s * x + c * y;
  }
  for (let k = 0; k < n; k++) {
    const x = v[k * n + p]!;
    const y = v[k * n + q]!;
    v[k * n + p] = c * x - s * y;
    v[k * n + q] = s * x + c * y;
  }
}
