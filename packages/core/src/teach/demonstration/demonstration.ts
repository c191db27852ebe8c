import type { Pose } from "../../spatial/pose.ts";

/** What a hand showed: the pose of the tool at moments, and whether the hand held something. */
export interface Demonstration {
  /** Seconds, strictly increasing. */
  readonly times_s: readonly number[];
  readonly worldFromTcp: readonly Pose<"world", "tcp">[];
  readonly closed: readonly boolean[];
}

/** Fewer samples than this show no motion. */
export const LEAST_SAMPLES = 2;
/** More samples than this (2.7 hours at 100 a second) are refused. */
export const MOST_SAMPLES = 1_000_000;

/** Mean number of samples a second (rows M-34 and M-55: 50 while teaching, 100 while simulating); 0 for one sample. */
export function sampleRate_Hz({ times_s }: Demonstration): number {
  const took_s = times_s.at(-1)! - times_s[0]!;
  return took_s > 0 ? (times_s.length - 1) / took_s : 0;
}
