/**
 * The mark on a work piece (row M-21): "free" while nothing touches it, "ready" while the fingers touch it, "held" while they
 * are closed on it. In the order of the source: (a), (b), (c); after release the fingers still touch: a, b, c, b, a (G3).
 */
export type GraspSignal = "free" | "ready" | "held";

/** What is known of hand and piece at one instant. */
export interface GraspSense {
  /** Row M-20, first half: how far the fingers are bent, 0 open … 1 closed; of a gripper, whether it is told to close. */
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

/** Where the mark sits on the piece, as a share of its height: it moves as well as changes colour (row M-21). */
export const GRASP_MARK_HEIGHT = { free: 0, ready: 0.5, held: 1 } as const satisfies Record<GraspSignal, number>;
