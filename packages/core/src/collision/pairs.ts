/**
 * What is known of two parts of the robot: they follow each other along the arm; they touched in every posture that was
 * tried, so drawn shapes overlap there by design, or in a posture known to be free; the cell allows them; they touched
 * in some postures, or in none that was tried.
 */
export type PairReason = "adjacent" | "always" | "at home" | "allowed" | "sometimes" | "never seen";

export interface PairEntry {
  readonly a: string;
  readonly b: string;
  readonly reason: PairReason;
  /** Postures tried and postures in contact; 0 and 0 where none had to be tried. */
  readonly samples: number;
  readonly touches: number;
  /**
   * Whether the pair is looked at. A pair never seen in contact still is: samples prove nothing, and boxes far apart
   * cost nothing.
   */
  readonly watched: boolean;
}

/** Which parts of a robot are checked against which. Plain data: may be kept, shown as a matrix and edited. */
export interface PairMatrix {
  readonly seed: number;
  readonly entries: readonly PairEntry[];
}
