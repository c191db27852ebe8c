/** Pieces of constant jerk of one axis at most: a brake of three, and two profiles of seven laid over each other. */
export const MAX_PIECES = 17;

/**
 * A jerk-limited motion of n axes that start and arrive together: for each axis pieces of constant jerk one behind the
 * other. Written over by every plan; sampling and planning allocate nothing.
 */
export class JerkMotion {
  readonly axes: number;
  duration_s = 0;
  /** "phase": all axes run along a straight line of the joint space; "time": they only arrive together. */
  synchronised: "phase" | "time" = "phase";
  /** Pieces of each axis. */
  readonly pieces: Uint8Array;
  /** axes × MAX_PIECES: begin [s], jerk, and acceleration, speed and place at the begin. */
  readonly begin: Float64Array;
  readonly jerk: Float64Array;
  readonly acceleration: Float64Array;
  readonly speed: Float64Array;
  readonly place: Float64Array;
  /** The state at the end, as it was asked for. */
  readonly endPlace: Float64Array;
  readonly endSpeed: Float64Array;
  readonly endAcceleration: Float64Array;

  constructor(axes: number) {
    const size = axes * MAX_PIECES;
    this.axes = axes;
    this.pieces = new Uint8Array(axes);
    this.begin = new Float64Array(size);
    this.jerk = new Float64Array(size);
    this.acceleration = new Float64Array(size);
    this.speed = new Float64Array(size);
    this.place = new Float64Array(size);
    this.endPlace = new Float64Array(axes);
    this.endSpeed = new Float64Array(axes);
    this.endAcceleration = new Float64Array(axes);
  }

  /**
   * State of one instant. Before the begin it is the first, at and behind the end exactly the last.
   *
   * @param outPlace @param outSpeed @param outAcceleration  `axes` numbers each.
   */
  sample(t_s: number, outPlace: Float64Array, outSpeed?: Float64Array, outAcceleration?: Float64Array): void {
    for (let i = 0; i < this.axes; i++) {
      if (t_s >= this.duration_s) {
        outPlace[i] = this.endPlace[i]!;
        if (outSpeed) outSpeed[i] = this.endSpeed[i]!;
        if (outAcceleration) outAcceleration[i] = this.endAcceleration[i]!;
        continue;
      }
      const first = i * MAX_PIECES;
      let k = first + this.pieces[i]! - 1;
      while (k > first && this.begin[k]! > t_s) k--;
      const t = Math.max(0, t_s - this.begin[k]!);
      const j = this.jerk[k]!;
      const a = this.acceleration[k]!;
      const v = this.speed[k]!;
      outPlace[i] = this.place[k]! + t * (v + t * (a / 2 + (t * j) / 6));
      if (outSpeed) outSpeed[i] = v + t * (a + (t * j) / 2);
      if (outAcceleration) outAcceleration[i] = a + t * j;
    }
  }

  /** Times at which the jerk of some axis changes, both ends included, rising. Allocates. */
  knots_s(): Float64Array {
    const all: number[] = [0, this.duration_s];
    for (let i = 0; i < this.axes; i++)
      for (let k = 0; k < this.pieces[i]!; k++) all.push(this.begin[i * MAX_PIECES + k]!);
    const sorted = Float64Array.from(all).sort();
    let count = 0;
    for (let k = 0; k < sorted.length; k++) {
      const t = sorted[k]!;
      if (t > this.duration_s) break;
      // Knots closer than rounding are one; the end stays exact.
      if (count > 0 && t - sorted[count - 1]! <= 1e-12 * this.duration_s) {
        if (t === this.duration_s) sorted[count - 1] = t;
        continue;
      }
      sorted[count++] = t;
    }
    return sorted.slice(0, count);
  }
}
