import type { Joint } from "@twincell/core";

/** Speeds are looked at over this long, so that one frame that came late is no speed [ms]. */
const OVER_MS = 120;
/** A hand that rests longer has no speed [ms]. */
const RESTED_MS = 400;

/** The joint that is nearest to its speed limit, from 1, and how near: 1 is the limit. */
export interface FastestJoint {
  readonly joint: number;
  readonly share: number;
}

/** Watches joint speeds while a hand drags the tool: differences of angles over time, against the limits (row L-26). */
export class HandWatch {
  #from: Float64Array = new Float64Array(0);
  #since_ms = Number.NEGATIVE_INFINITY;
  #seen = -1;
  #last: FastestJoint | null = null;

  /** @param revision  counts up when the joints move. @param now_ms  the clock of the page. */
  look(
    joints: readonly Pick<Joint, "limits">[],
    q_rad: Float64Array,
    revision: number,
    now_ms: number,
  ): FastestJoint | null {
    const passed_ms = now_ms - this.#since_ms;
    if (this.#from.length !== q_rad.length || passed_ms > RESTED_MS) {
      this.#from = Float64Array.from(q_rad);
      this.#since_ms = now_ms;
      this.#seen = revision;
      this.#last = null;
      return null;
    }
    if (passed_ms < OVER_MS) return this.#last;
    let joint = 0;
    let share = 0;
    for (const [i, { limits }] of joints.entries()) {
      const own = (1000 * Math.abs(q_rad[i]! - this.#from[i]!)) / passed_ms / limits.speed_rad_s;
      if (own > share) {
        share = own;
        joint = i;
      }
    }
    this.#last = this.#seen === revision ? null : { joint: joint + 1, share };
    this.#from.set(q_rad);
    this.#since_ms = now_ms;
    this.#seen = revision;
    return this.#last;
  }
}
