import { samplePlan, type Finding, type Plan, type Refusal } from "@twincell/core";
import type { CellMember } from "../cell/index.ts";

/** Looked at along the way ahead [s]. */
const STEP_S = 0.1;
/** A way is looked through before it is sent as far as this [s]. */
export const PREVIEW_S = 60;
/** How far ahead a person may look [s]. */
export const MIN_AHEAD_S = 0.5;
export const MAX_AHEAD_S = 10;

/** What stands in the way ahead, and when it is reached as fast as the robot goes now. */
export interface Foreseen {
  readonly code: string;
  readonly sentence: string;
  readonly in_s: number;
}

export interface LookAheadOptions {
  readonly name: string;
  readonly plan: Plan;
  readonly joints: number;
  /** What the check found on the plan, in order of time. */
  readonly findings: readonly Finding[];
  /** Those of them that keep the program from being sent; the others are told. */
  readonly bad?: readonly Finding[];
  /** Among the other robots of the cell. */
  readonly place: CellMember | null;
}

/**
 * Looks along a plan ahead of the robot that carries it out. Where the robot is on its plan comes from outside, by its
 * own progress: a robot that is slowed or held meets everything later, and so it is told.
 *
 * A sweep over the other robots is spread over many calls: each looks at a few instants and allocates nothing while
 * nothing is found. Others are expected where their own plans have them, else where they come to rest.
 */
export class LookAhead {
  readonly #options: LookAheadOptions;
  readonly #q: Float64Array;
  readonly #others = new Map<string, Float64Array>();
  #next_s = 0;
  #robot: Foreseen | null = null;
  /** The first thing found ahead; null while the way is free as far as it was looked at. */
  problem: Foreseen | null = null;

  constructor(options: LookAheadOptions) {
    this.#options = options;
    this.#q = new Float64Array(options.joints);
  }

  /**
   * Where the robot will be in so many seconds; returns how many seconds of the way there are left, if that is less.
   */
  ghost(at_s: number, rate: number, in_s: number, out: Float64Array): number {
    const { plan } = this.#options;
    const left_s = rate > 0 ? (plan.duration_s - at_s) / rate : Infinity;
    samplePlan(plan, Math.min(plan.duration_s, at_s + in_s * rate), out);
    return Math.min(in_s, left_s);
  }

  /**
   * Goes on looking.
   *
   * @param at_s   the time of the plan at which the robot is.
   * @param rate   seconds of the plan that pass in a second: its override.
   * @param looks  instants to look at in this call.
   */
  look(at_s: number, rate: number, horizon_s: number, looks: number): void {
    const { plan } = this.#options;
    for (let i = 0; i < looks; i++) {
      const in_s = this.#next_s;
      const t_s = at_s + in_s * rate;
      // Nobody is met by one who is held; others that come near are their own guards' matter.
      if (in_s > horizon_s || t_s > plan.duration_s || rate <= 0) {
        this.#next_s = 0;
        this.#robot = null;
        break;
      }
      this.#next_s += STEP_S;
      const met = this.#meets(t_s, in_s, false);
      if (!met) continue;
      this.#robot = met;
      this.#next_s = 0;
      break;
    }
    this.problem = earlier(this.#found(at_s, rate, horizon_s), this.#robot);
  }

  /**
   * The first thing in the way from the start on, at full override: what keeps it from being sent, and what is only
   * told.
   */
  preview(): { readonly blocked: Foreseen | null; readonly told: Foreseen | null } {
    const { plan, bad: red = [] } = this.#options;
    const end_s = Math.min(PREVIEW_S, plan.duration_s);
    let standing: Foreseen | null = null;
    let met: Foreseen | null = null;
    // Who begins too near to a robot may go away from it: its guard sees to it that it comes no nearer.
    let from_s = 0;
    while (from_s <= end_s && this.#meets(from_s, 0, true)) from_s += STEP_S;
    if (from_s > end_s) from_s = 0;
    for (let t_s = from_s; t_s <= end_s && !(standing && met); t_s += STEP_S) {
      standing ??= this.#meets(t_s, t_s, true);
      met ??= standing ?? this.#meets(t_s, t_s, false);
    }
    // The check looked at the whole plan: what it found late blocks as what it found at once.
    const [bad] = red;
    return {
      blocked: earlier(bad ? { code: bad.code, sentence: bad.sentence, in_s: bad.at_s } : null, standing),
      told: earlier(this.#found(0, 1, end_s), met),
    };
  }

  #found(at_s: number, rate: number, horizon_s: number): Foreseen | null {
    if (rate <= 0) return null;
    for (const { at_s: there_s, code, sentence } of this.#options.findings) {
      const in_s = (there_s - at_s) / rate;
      if (in_s >= 0 && in_s <= horizon_s) return { code, sentence, in_s };
    }
    return null;
  }

  /** @param standing  only robots that stand: those that move may be elsewhere by then. */
  #meets(t_s: number, in_s: number, standing: boolean): Foreseen | null {
    const { plan, place, name } = this.#options;
    if (!place || place.others.length === 0) return null;
    samplePlan(plan, t_s, this.#q);
    for (const other of place.others) {
      if (standing && other.moving) continue;
      let its = this.#others.get(other.id);
      if (!its) this.#others.set(other.id, (its = new Float64Array(other.joints)));
      other.expected(in_s, its);
      const distance_m = other.distance(this.#q, its, other.kept_m + other.error_m);
      if (distance_m < Infinity)
        return {
          code: "ahead.robot",
          in_s,
          sentence: `${name} comes within ${Math.round(1000 * Math.max(0, distance_m - other.error_m))} mm of ${other.name}; ${Math.round(1000 * other.kept_m)} mm are kept.`,
        };
    }
    return null;
  }
}

const earlier = (a: Foreseen | null, b: Foreseen | null): Foreseen | null =>
  !a ? b : !b ? a : b.in_s < a.in_s ? b : a;

/** Why a way is not begun. */
export const pathBlocked = ({ code, sentence, in_s }: Foreseen): Refusal => ({
  code,
  sentence: `After ${in_s.toFixed(1)} s: ${sentence}`,
  hint: "It was not sent. Clear the way, or change the program.",
});
