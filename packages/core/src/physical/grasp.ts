/**
 * The mark on a work piece (row M-21): "free" while nothing touches it, "ready" while the fingers touch it, "held"
 * while they are closed on it. In the order of the source: (a), (b), (c); after release the fingers still touch: a, b,
 * c, b, a (G3).
 */
export type GraspSignal = "free" | "ready" | "held";

/** What is known of hand and piece at one instant. */
export interface GraspSense {
  /**
   * Row M-20, first half: how far the fingers are bent, 0 open … 1 closed; of a gripper, whether it is told to close.
   */
  readonly bend: number;
  /** Row M-20, second half: of the hand from the piece [m]; 0 where they touch. */
  readonly distance_m: number;
  /** The piece is touched from two sides. */
  readonly between: boolean;
  /** Row M-19: tables and conveyors are not. */
  readonly graspable: boolean;
}

/** Fingers bent less than this do not hold. */
export const HOLDING_BEND = 0.5;
/** A hand nearer than this touches [m]. */
export const TOUCHING_M = 0.001;

/** The next signal. Both are needed to hold: fingers that are bent, and a piece between them. */
export function graspSignal({ bend, distance_m, between, graspable }: GraspSense): GraspSignal {
  if (!graspable || distance_m > TOUCHING_M) return "free";
  return between && bend >= HOLDING_BEND ? "held" : "ready";
}

/**
 * The signal as it is shown: one state after the other, so that a piece is touched before and after it is held, and
 * none shorter than the eye and a debounced input need.
 */
export class GraspFilter {
  private now: GraspSignal = "free";
  private wanted: GraspSignal = "free";
  private waited_s = 0;
  private shown_s = GRASP_SHOWN_S;

  /** @returns the signal after another `dt_s` in which the piece was in the state sensed. */
  step(sensed: GraspSignal, dt_s: number): GraspSignal {
    this.shown_s += dt_s;
    if (sensed !== this.wanted) {
      this.wanted = sensed;
      this.waited_s = 0;
    } else this.waited_s += dt_s;
    if (this.wanted !== this.now && this.waited_s >= GRASP_SURE_S && this.shown_s >= GRASP_SHOWN_S) {
      this.now = this.now !== "ready" ? "ready" : this.wanted;
      this.shown_s = 0;
    }
    return this.now;
  }

  reset(): void {
    this.now = this.wanted = "free";
    this.waited_s = 0;
    this.shown_s = GRASP_SHOWN_S;
  }
}

/** What is sensed for this long is believed, and what is shown stays at least so long [s]. */
export const GRASP_SURE_S = 0.01;
export const GRASP_SHOWN_S = 0.03;

/** Where the mark sits on the piece, as a share of its height: it moves as well as changes colour (row M-21). */
export const GRASP_MARK_HEIGHT = { free: 0, ready: 0.5, held: 1 } as const satisfies Record<GraspSignal, number>;
