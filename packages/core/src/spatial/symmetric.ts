/**
 * Solves A x = b for a symmetric, positive definite A by Cholesky, in place: the lower half of A is read and becomes
 * its factor, b becomes x. Allocates nothing.
 *
 * @param A n × n, row by row
 * @param b n numbers
 * @returns false when A is not positive definite; then A and b are of no use
 */
export function solveSymmetric(A: Float64Array, b: Float64Array, n: number): boolean {
  for (let i = 0; i < n; i++) {
    for (let j = 0; j <= i; j++) {
      let sum = A[n * i + j]!;
      for (let k = 0; k < j; k++) sum -= A[n * i + k]! * A[n * j + k]!;
      if (i === j) {
        if (!(sum > 0)) return false;
        A[n * i + i] = Math.sqrt(sum);
      } else A[n * i + j] = sum / A[n * j + j]!;
    }
  }
  solveFactored(A, b, n);
  return true;
}

/** The same for another b, with the factor that `solveSymmetric` left in A. */
export function solveFactored(A: Float64Array, b: Float64Array, n: number): void {
  for (let i = 0; i < n; i++) {
    let sum = b[i]!;
    for (let k = 0; k < i; k++) sum -= A[n * i + k]! * b[k]!;
    b[i] = sum / A[n * i + i]!;
  }
  for (let i = n - 1; i >= 0; i--) {
    let sum = b[i]!;
    for (let k = i + 1; k < n; k++) sum -= A[n * k + i]! * b[k]!;
    b[i] = sum / A[n * i + i]!;
  }
}
