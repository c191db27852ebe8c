import { hardBrakingTime_s, jerkOf, type JointSample, type Robot } from "@twincell/core";

/** From seeing to the stop taking effect [s]. */
export const REACTION_S = 0.02;
/** A braking time longer than the accelerations alone need by this much spares the gears as well [s]. */
const SPARING_S = 0.02;

/**
 * Where a robot would come to rest if it were stopped now, its joints going on the way they go:
 *
 *   q + (q̇ + q̇') / 2 · t_reaction + q̇' · t_braking / 2
 *
 * q̇' is the speed when the stop takes effect. All joints brake as long as the one that needs longest, as robots do
 * that stop along their path. A stop within the accelerations takes |q̇| / a; one that spares the gears
 *
 *   |q̇| / a + a / j   where |q̇| ≥ a² / j,   else 2 √(|q̇| / j)
 *
 * and, where the joint still gains speed at q̈, q̈ / j more until that is taken back. Allocates nothing per sample.
 */
export class StopForecast {
  /** Where it stands now, and where it would [rad]. Lent. */
  readonly q_rad: Float64Array;
  readonly ahead_rad: Float64Array;
  readonly #robot: Robot;
  readonly #braking_s: number;
  readonly #delay_s: number;
  readonly #isSparing: boolean;
  readonly #rate_rad_s: Float64Array;
  readonly #then_rad_s: Float64Array;

  /**
   * @param braking_s  from full speed of the slowest joint to rest.
   * @param delay_s    how old samples are and how long a stop is under way, together.
   */
  constructor(robot: Robot, q_rad: ArrayLike<number>, braking_s: number, delay_s: number) {
    this.#robot = robot;
    this.#braking_s = braking_s;
    this.#delay_s = delay_s;
    this.#isSparing = braking_s > hardBrakingTime_s(robot) + SPARING_S;
    this.q_rad = Float64Array.from(q_rad);
    this.ahead_rad = Float64Array.from(q_rad);
    this.#rate_rad_s = new Float64Array(q_rad.length);
    this.#then_rad_s = new Float64Array(q_rad.length);
  }

  /** From the word to stop to standstill at full speed, its way included [s]. */
  get reach_s(): number {
    return REACTION_S + this.#delay_s + this.#braking_s;
  }

  /** It stands there, without having moved there: how far that is from where it stood says nothing of its speed. */
  standAt(q_rad: ArrayLike<number>): void {
    this.q_rad.set(q_rad);
    this.ahead_rad.set(q_rad);
    this.#rate_rad_s.fill(0);
    this.#then_rad_s.fill(0);
  }

  /** @param dt_s  since the sample before; NaN where that is not known. */
  take({ q_rad, target_rad }: JointSample, dt_s: number): void {
    const known = dt_s > 0;
    const { joints } = this.#robot.arm;
    // The difference of two samples is a speed half a sample old, and the next look is a sample away: a joint gains
    // speed meanwhile, but not faster than it can, whatever the times of the samples say.
    const age_s = known ? Math.min(dt_s, REACTION_S) + this.#delay_s : 0;
    let braking_s = 0;
    for (let i = 0; i < joints.length; i++) {
      const { limits } = joints[i]!;
      const rate = known ? (q_rad[i]! - this.q_rad[i]!) / dt_s : 0;
      const most = Math.max(limits.speed_rad_s, Math.abs(rate));
      const gain = known
        ? Math.min(limits.acceleration_rad_s2, Math.max(0, (Math.abs(rate) - Math.abs(this.#rate_rad_s[i]!)) / dt_s))
        : 0;
      const then = Math.min(most, Math.abs(rate) + gain * age_s);
      this.#rate_rad_s[i] = rate;
      this.#then_rad_s[i] = Math.sign(rate) * then;
      braking_s = Math.max(braking_s, this.#brakingOf(i, then, gain));
      this.q_rad[i] = q_rad[i]!;
    }
    // From where it is commanded to be by now, where the controller says so: what was commanded will come.
    const from_rad = target_rad ?? q_rad;
    const reaction_s = REACTION_S + this.#delay_s;
    for (let i = 0; i < joints.length; i++) {
      const then = this.#then_rad_s[i]!;
      this.ahead_rad[i] = from_rad[i]! + ((this.#rate_rad_s[i]! + then) / 2) * reaction_s + (then * braking_s) / 2;
    }
  }

  #brakingOf(joint: number, speed_rad_s: number, gain_rad_s2: number): number {
    const { limits } = this.#robot.arm.joints[joint]!;
    const part = speed_rad_s / limits.speed_rad_s;
    if (!this.#isSparing) return part * this.#braking_s;
    const a = limits.acceleration_rad_s2;
    const j = jerkOf(limits);
    const needed_s = speed_rad_s >= (a * a) / j ? speed_rad_s / a + a / j : 2 * Math.sqrt(speed_rad_s / j);
    return Math.max(part * this.#braking_s, needed_s + gain_rad_s2 / j);
  }
}
