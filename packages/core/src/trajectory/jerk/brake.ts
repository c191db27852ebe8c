/** Phases of a brake at most. */
export const BRAKE_PHASES = 3;

/**
 * The fastest way from a state outside the limits back to one that keeps them: first the acceleration is brought within
 * its limit, then a speed that is or will be too high is taken down with full jerk until it is at its limit.
 *
 * @param out  receives up to three pairs of duration [s] and jerk, from index 0 on.
 * @returns    number of phases; 0 for a state that keeps the limits.
 */
export function brake(
  v: number,
  a: number,
  speed: number,
  acceleration: number,
  jerk: number,
  out: Float64Array,
): number {
  let phases = 0;
  let v0 = v;
  let a0 = a;
  if (Math.abs(a0) > acceleration) {
    const j = a0 > 0 ? -jerk : jerk;
    const t = (Math.abs(a0) - acceleration) / jerk;
    out[0] = t;
    out[1] = j;
    phases = 1;
    v0 += a0 * t + (j * t * t) / 2;
    a0 = a0 > 0 ? acceleration : -acceleration;
  }
  const settles = v0 + (a0 * Math.abs(a0)) / (2 * jerk);
  const sign = settles > speed ? 1 : settles < -speed ? -1 : v0 > speed ? 1 : v0 < -speed ? -1 : 0;
  if (sign === 0) return phases;
  v0 *= sign;
  a0 *= sign;
  // On the way down v = c − a²/2j (a < 0 behind the peak). It may end at V, at −A, or where −V could no longer be kept.
  const c = v0 + (a0 * a0) / (2 * jerk);
  const atLimit = Math.sqrt(Math.max(0, 2 * jerk * (c - speed)));
  const atFloor = Math.sqrt(Math.max(0, jerk * (c + speed)));
  const low = Math.max(Math.min(acceleration, atLimit, atFloor), Math.max(0, -a0));
  const t = (a0 + low) / jerk;
  if (t > 0) {
    out[2 * phases] = t;
    out[2 * phases + 1] = -sign * jerk;
    phases++;
  }
  if (low >= acceleration * (1 - 1e-12)) {
    const reached = c - (low * low) / (2 * jerk);
    const goal = Math.max(speed, -speed + (low * low) / (2 * jerk));
    if (reached > goal) {
      out[2 * phases] = (reached - goal) / low;
      out[2 * phases + 1] = 0;
      phases++;
    }
  }
  return phases;
}
