/** Two columns count as perpendicular when their cosine is below this. */
const PERPENDICULAR = 1e-15;
const MOST_SWEEPS = 30;

/**
 * Singular values of a Jacobian, largest first: how far the tip goes per unit of joint motion along the six directions
 * it can go, the last along the worst. The last is 0 on a singularity.
 *
 * One-sided Jacobi rotations: columns are turned against each other until they are perpendicular; their lengths are
 * left. For up to six joints; with more, turn the matrix first.
 *
 * @param jacobianRows  6 × n numbers, row major, n ≤ 6, all finite. Read only.
 * @see Golub & Van Loan, Matrix Computations, 4th ed., 8.6.3.
 */
export function singularValues(jacobianRows: Float64Array): Float64Array {
  const n = jacobianRows.length / 6;
  const a = jacobianRows.slice();
  for (let sweep = 0, turned = true; turned && sweep < MOST_SWEEPS; sweep++) {
    turned = false;
    for (let i = 0; i < n - 1; i++) {
      for (let j = i + 1; j < n; j++) {
        let ii = 0;
        let jj = 0;
        let ij = 0;
        for (let row = 0; row < 6; row++) {
          const x = a[row * n + i]!;
          const y = a[row * n + j]!;
          ii += x * x;
          jj += y * y;
          ij += x * y;
        }
        if (Math.abs(ij) <= PERPENDICULAR * Math.sqrt(ii * jj)) continue;
        turned = true;
        const zeta = (jj - ii) / (2 * ij);
        const t = (zeta < 0 ? -1 : 1) / (Math.abs(zeta) + Math.sqrt(1 + zeta * zeta));
        const c = 1 / Math.sqrt(1 + t * t);
        const s = c * t;
        for (let row = 0; row < 6; row++) {
          const x = a[row * n + i]!;
          const y = a[row * n + j]!;
          a[row * n + i] = c * x - s * y;
          a[row * n + j] = s * x + c * y;
        }
      }
    }
  }
  const lengths = Float64Array.from({ length: n }, (_, i) => {
    let sum = 0;
    for (let row = 0; row < 6; row++) sum += a[row * n + i]! ** 2;
    return Math.sqrt(sum);
  });
  return lengths.sort((x, y) => y - x);
}

/** Yoshikawa's measure √det(J Jᵀ): the product of the singular values, 0 on a singularity. */
export const manipulability = (jacobianRows: Float64Array): number =>
  singularValues(jacobianRows).reduce((product, value) => product * value, 1);
