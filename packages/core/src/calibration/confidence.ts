/** Of a standard normal distribution: 95 % are below. */
const Z95 = 1.6448536269514722;

/**
 * The number below which 95 % of an F distribution lie, to 2.5 %.
 *
 * @param over  degrees of freedom of the numerator, 1 or more (need not be whole)
 * @param under degrees of freedom of the denominator, 5 or more; Infinity gives χ² over its degrees of freedom
 * @see Paulson, An approximate normalization of the analysis of variance distribution, Ann. Math. Stat. 13(2) 1942.
 */
export function fBound95(over: number, under: number): number {
  const a = 2 / (9 * over);
  const b = under === Infinity ? 0 : 2 / (9 * under);
  const middle = (1 - b) * (1 - a);
  const spread = Math.sqrt((1 - b) * (1 - b) * a + (1 - a) * (1 - a) * b - a * b * Z95 * Z95);
  return ((middle + Z95 * spread) / ((1 - b) * (1 - b) - b * Z95 * Z95)) ** 3;
}

/**
 * The length that 95 % of normally distributed vectors stay below. Σ λ z² is taken for a scaled χ² of the same mean and
 * variance (Satterthwaite).
 *
 * @param variances along three axes at right angles to each other [m²]
 * @param freedom   degrees of freedom with which the variances were estimated; Infinity when they are known
 */
export function lengthBound95(variances: readonly number[], freedom: number): number {
  const sum = variances.reduce((total, value) => total + value, 0);
  const squares = variances.reduce((total, value) => total + value * value, 0);
  if (!(sum > 0)) return 0;
  return Math.sqrt(sum * fBound95((sum * sum) / squares, freedom));
}
