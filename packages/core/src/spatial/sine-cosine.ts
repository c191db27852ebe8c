/** Beyond this the two-part π/2 runs out of digits and the engine's own functions take over [rad]. */
const LARGEST_rad = 1e5;
const TWO_OVER_PI = 0.6366197723675814;
/** π/2 in two parts; the first has 33 bits, so that its products with small integers are exact. */
const QUARTER_HIGH = 1.57079632673412561417;
const QUARTER_LOW = 6.07710050650619224932e-11;
/** Adding and taking away 1.5 · 2⁵² rounds to an integer. */
const ROUND = 6755399441055744;

/**
 * out[0] = sin(angle), out[1] = cos(angle), within one unit in the last place of `Math.sin` and `Math.cos`. For hot
 * loops: `Math.*` branches on the angle, which a processor mispredicts half the time when angles vary; this does not,
 * and is the same to the last bit in every engine.
 * NaN and ±∞ give NaN.
 *
 * @see Cody & Waite, Software Manual for the Elementary Functions, 1980; coefficients of fdlibm 5.3, k_sin.c and
 * k_cos.c.
 */
export function sineCosine(angle_rad: number, out: Float64Array): void {
  if (!(Math.abs(angle_rad) < LARGEST_rad)) {
    out[0] = Math.sin(angle_rad);
    out[1] = Math.cos(angle_rad);
    return;
  }
  const n = angle_rad * TWO_OVER_PI + ROUND - ROUND;
  const r = angle_rad - n * QUARTER_HIGH - n * QUARTER_LOW;
  const z = r * r;
  const w = z * z;
  const sine =
    r +
    r *
      z *
      (-1.66666666666666324348e-1 +
        z * 8.33333333332248946124e-3 +
        w *
          (-1.98412698298579493134e-4 +
            z * 2.75573137070700676789e-6 +
            w * (-2.50507602534068634195e-8 + z * 1.58969099521155010221e-10)));
  const tail =
    w *
    (4.16666666666666019037e-2 +
      z * -1.38888888888741095749e-3 +
      w *
        (2.48015872894767294178e-5 +
          z * -2.75573143513906633035e-7 +
          w * (2.0875723212981748279e-9 + z * -1.13596475577881948265e-11)));
  const half = 0.5 * z;
  const whole = 1 - half;
  const cosine = whole + (1 - whole - half + tail);
  // Quarter turns swap the two and change signs; without branches, since random angles would mispredict them.
  const quarter = n | 0;
  const odd = quarter & 1;
  const signOfSine = 1 - (quarter & 2);
  const signOfCosine = 1 - ((quarter + 1) & 2);
  out[odd] = sine * (odd === 0 ? signOfSine : signOfCosine);
  out[1 - odd] = cosine * (odd === 0 ? signOfCosine : signOfSine);
}
