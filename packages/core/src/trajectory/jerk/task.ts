/** Limits of one axis, the same in both directions: rad/s, rad/s², rad/s³ for a joint, m/s, m/s², m/s³ along a path. */
export interface JerkLimits {
  readonly speed: number;
  readonly acceleration: number;
  readonly jerk: number;
}

/**
 * From one state of an axis to another: speed and acceleration at both ends, the way between them, and the limits.
 * Written over from axis to axis, so that planning allocates nothing.
 */
export interface AxisTask {
  v0: number;
  a0: number;
  v1: number;
  a1: number;
  way: number;
  speed: number;
  acceleration: number;
  jerk: number;
}
export const axisTask = (): AxisTask => ({ v0: 0, a0: 0, v1: 0, a1: 0, way: 0, speed: 1, acceleration: 1, jerk: 1 });

/** Speeds and accelerations this share over their limits are rounding. */
const ROUNDING = 1e-9;

/**
 * Whether a state can be left without its speed passing the limit, the acceleration being taken back at once:
 *
 *   |a| ≤ A,   |v + a |a| / 2j| ≤ V
 */
export function canBeLeft(v: number, a: number, speed: number, acceleration: number, jerk: number): boolean {
  return (
    Math.abs(a) <= acceleration * (1 + ROUNDING) &&
    Math.abs(v + (a * Math.abs(a)) / (2 * jerk)) <= speed * (1 + ROUNDING) &&
    Math.abs(v) <= speed * (1 + ROUNDING)
  );
}

/**
 * Whether a state can be arrived at without its speed having passed the limit: the same with time running backwards.
 */
export const canBeReached = (v: number, a: number, speed: number, acceleration: number, jerk: number): boolean =>
  canBeLeft(v, -a, speed, acceleration, jerk);
