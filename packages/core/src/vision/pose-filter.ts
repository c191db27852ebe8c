import { fromAxisAngle, multiply, normalizeQuaternion, type Quaternion } from "../spatial/quaternion.ts";
import type { Pose } from "../spatial/pose.ts";

/** After a pause this long, or a jump this far, the next pose is taken as it comes. */
const MAX_GAP_S = 0.4;
const JUMP_M = 0.25;
const JUMP_RAD = 0.8;
/** What a difference from the prediction counts as motion at, rather than as noise. */
const MOTION_M = 0.003;
const MOTION_RAD = (1 * Math.PI) / 180;
const MIN_GAIN = 0.12;

/**
 * Smooths poses without falling behind: each is predicted from the velocities so far, and the difference is taken in
 * with a gain that is small for noise and near one for motion (α–β filter, β = α² / (2 − α)). At constant speed the
 * error goes to zero. Nothing is allocated once it is made.
 *
 * @see Benedict and Bordner, Synthesis of an optimal set of radar track-while-scan smoothing equations, 1962.
 */
export class PoseFilter {
  /** The smoothed pose; borrowed. */
  readonly pose: Pose = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
  readonly #velocity = new Float64Array(3);
  readonly #spin = new Float64Array(3);
  readonly #residual = new Float64Array(3);
  readonly #turn: Quaternion = [0, 0, 0, 1];
  readonly #axis: [number, number, number] = [0, 0, 0];
  readonly #conjugate: Quaternion = [0, 0, 0, 1];
  #at_s = -Infinity;

  /** Forgets everything: the next pose is taken as it comes. */
  reset(): void {
    this.#at_s = -Infinity;
  }

  /** Where it would be at a time by its velocities, written over `pose`; false after a pause. */
  predict(at_s: number): boolean {
    const dt = at_s - this.#at_s;
    if (!(dt >= 0 && dt < MAX_GAP_S)) return false;
    for (let i = 0; i < 3; i++) this.pose.position[i]! += this.#velocity[i]! * dt;
    this.#turnBy(this.#spin, dt);
    this.#at_s = at_s;
    return true;
  }

  /**
   * Takes in a measured pose.
   *
   * @param at_s when the picture was taken, by any clock that only goes forward
   */
  add(measured: Pose, at_s: number): Pose {
    const dt = at_s - this.#at_s;
    if (!this.predict(at_s)) return this.#restart(measured, at_s);
    const r = this.#residual;
    for (let i = 0; i < 3; i++) r[i] = measured.position[i]! - this.pose.position[i]!;
    const far = Math.sqrt(r[0]! * r[0]! + r[1]! * r[1]! + r[2]! * r[2]!);
    if (far > JUMP_M) return this.#restart(measured, at_s);
    const alpha = gain(far / MOTION_M);
    const beta = (alpha * alpha) / (2 - alpha);
    for (let i = 0; i < 3; i++) {
      this.pose.position[i]! += alpha * r[i]!;
      if (dt > 0) this.#velocity[i]! += (beta / dt) * r[i]!;
    }
    const angle = this.#turnTo(measured.quaternion);
    if (angle > JUMP_RAD) return this.#restart(measured, at_s);
    const turnAlpha = gain(angle / MOTION_RAD);
    const turnBeta = (turnAlpha * turnAlpha) / (2 - turnAlpha);
    this.#turnBy(r, turnAlpha);
    if (dt > 0) for (let i = 0; i < 3; i++) this.#spin[i]! += (turnBeta / dt) * r[i]!;
    return this.pose;
  }

  #restart(measured: Pose, at_s: number): Pose {
    this.#at_s = at_s;
    this.#velocity.fill(0);
    this.#spin.fill(0);
    for (let i = 0; i < 3; i++) this.pose.position[i] = measured.position[i]!;
    for (let i = 0; i < 4; i++) this.pose.quaternion[i] = measured.quaternion[i]!;
    return this.pose;
  }

  /** The turn from the present to another orientation, as a rotation vector in `#residual`; returns its angle. */
  #turnTo(to: Quaternion): number {
    const q = this.pose.quaternion;
    const c = this.#conjugate;
    c[0] = -q[0];
    c[1] = -q[1];
    c[2] = -q[2];
    c[3] = q[3];
    const d = multiply(to, c, this.#turn);
    const sign = d[3] < 0 ? -1 : 1;
    const s = Math.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const angle = 2 * Math.atan2(s, Math.abs(d[3]));
    const k = s < 1e-12 ? 2 * sign : (sign * angle) / s;
    for (let i = 0; i < 3; i++) this.#residual[i] = k * d[i]!;
    return angle;
  }

  #turnBy(vector: Float64Array, share: number): void {
    const angle = Math.sqrt(vector[0]! * vector[0]! + vector[1]! * vector[1]! + vector[2]! * vector[2]!);
    if (angle < 1e-12) return;
    for (let i = 0; i < 3; i++) this.#axis[i] = vector[i]! / angle;
    fromAxisAngle(this.#axis, angle * share, this.#turn);
    multiply(this.#turn, this.pose.quaternion, this.#conjugate);
    normalizeQuaternion(this.#conjugate, this.pose.quaternion);
  }
}

const gain = (ratio: number): number => MIN_GAIN + (1 - MIN_GAIN) * Math.min(1, ratio ** 4);
