import { samplePlan, type Plan } from "@twincell/core";

/** How far ahead and back along the plan the robot is looked for, in steps of so long [s]. */
interface Search {
  readonly step_s: number;
  readonly back: number;
  readonly ahead: number;
}
/** Where it can be a sample later, and where it can be when samples were missing. */
const AT_HAND: Search = { step_s: 0.0125, back: 2, ahead: 4 };
const WIDE: Search = { step_s: 0.05, back: 2, ahead: 8 };
const HALVINGS = 5;
/** A robot this near to the place at hand is there, even if the plan comes by nearer later [rad]. */
const THERE_RAD = 0.002;

/** Largest differences of any joint [rad]; NaN where one of both is not known. */
export interface Deviation {
  /** From the nearest place of the plan: how late the robot is does not count, where it is does. */
  plan_rad: number;
  /** Of the measured angles from those the controller commands at the same time. */
  command_rad: number;
}

/**
 * Follows a plan with a robot that executes it, at whatever override: the place on the plan nearest to the measured
 * angles, searched around the place found before. Around a place where the plan turns back, the way there and the way
 * back are the same place. Allocates nothing per sample.
 */
export class PlanFollower {
  private readonly plan: Plan;
  private readonly q: Float64Array;
  private t_s = 0;

  constructor(plan: Plan, joints: number) {
    this.plan = plan;
    this.q = new Float64Array(joints);
  }

  /** The plan's time at which it passes nearest to where the robot last was. */
  get at_s(): number {
    return this.t_s;
  }

  /**
   * min over t near the last of max over joints of |q(t) − measured| [rad]; NaN for a plan that is nowhere and for
   * angles that are no numbers.
   */
  take(measured_rad: ArrayLike<number>): number {
    if (this.plan.segments.length === 0) return NaN;
    const from_s = this.t_s;
    const near = this.search(from_s, AT_HAND, measured_rad);
    const off = near <= THERE_RAD ? near : Math.min(near, this.search(from_s, WIDE, measured_rad));
    return off === Infinity ? NaN : off;
  }

  /** Goes to the nearest place around `from_s`, where that is nearer than the one it stands at; how far that is. */
  private search(from_s: number, { step_s, back, ahead }: Search, measured_rad: ArrayLike<number>): number {
    let best = this.far(this.t_s, measured_rad);
    let best_s = this.t_s;
    // Ahead first: a plan that turns round passes the same places twice, and a robot does not go back along it.
    for (let i = 0; i <= ahead + back; i++) {
      const k = i <= ahead ? i : ahead - i;
      const t_s = Math.min(this.plan.duration_s, Math.max(0, from_s + k * step_s));
      const far = this.far(t_s, measured_rad) + (k < 0 ? THERE_RAD : 0);
      if (far < best) {
        best = far;
        best_s = t_s;
      }
    }
    best = this.far(best_s, measured_rad);
    for (let width = step_s / 2, i = 0; i < HALVINGS; i++, width /= 2) {
      for (const t_s of [best_s - width, best_s + width]) {
        if (t_s < 0 || t_s > this.plan.duration_s) continue;
        const far = this.far(t_s, measured_rad);
        if (far < best) {
          best = far;
          best_s = t_s;
        }
      }
    }
    this.t_s = best_s;
    return Number.isNaN(best) ? Infinity : best;
  }

  private far(t_s: number, measured_rad: ArrayLike<number>): number {
    samplePlan(this.plan, t_s, this.q);
    let far = 0;
    for (let i = 0; i < this.q.length; i++) far = Math.max(far, Math.abs(this.q[i]! - measured_rad[i]!));
    return far;
  }
}
