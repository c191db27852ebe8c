import { pathDeviation, type Deviation } from "../../paths/curve.ts";
import { distance } from "../../spatial/vector.ts";
import type { Demonstration } from "./demonstration.ts";
import { demonstratedMotion } from "./motion.ts";

/** What an attempt must keep to be accepted (row M-61); what is left out is not asked for. */
export interface Acceptance {
  readonly within_m?: number | undefined;
  readonly within_s?: number | undefined;
  /** Times the expert's path length. */
  readonly pathRatio?: number | undefined;
}

export interface Attempt {
  readonly duration_s: number;
  readonly length_m: number;
  /** Distances of the attempt's samples from the expert's path. */
  readonly deviation: Deviation;
  /** Path length over the expert's: 1 is as short. */
  readonly pathRatio: number;
  /** Root mean square of the acceleration: a calm hand has little [m/s²]. */
  readonly unrest_mps2: number;
  /** 0 … 100. */
  readonly score: number;
  readonly accepted: boolean;
  /** What was not kept, with both numbers; empty when accepted. */
  readonly missed: readonly string[];
}

/** Deviation at which that part of the score is halved, where no acceptance says another [m]. */
const FAIR_M = 0.01;

const lengthOf = ({ worldFromTcp }: Demonstration): number =>
  worldFromTcp.slice(1).reduce((sum, { position }, i) => sum + distance(worldFromTcp[i]!.position, position), 0);
const durationOf = ({ times_s }: Demonstration): number => times_s.at(-1)! - times_s[0]!;

/**
 * How well an attempt follows the expert's (rows M-61, M-62): the mean of three parts, each 1 when as good as the
 * expert's,
 *
 *   accuracy = 1 / (1 + rms / fair),   time = min(1, T_expert / T),   economy = min(1, L_expert / L)
 *
 * accuracy counting twice, times 100.
 */
export function judgeAttempt(attempt: Demonstration, expert: Demonstration, acceptance: Acceptance): Attempt {
  const path = expert.worldFromTcp.map(({ position }) => position);
  const deviation = pathDeviation(
    path,
    attempt.worldFromTcp.map(({ position }) => position),
  );
  const duration_s = durationOf(attempt);
  const length_m = lengthOf(attempt);
  const pathRatio = length_m / Math.max(lengthOf(expert), 1e-9);
  const { acceleration_mps2 } = demonstratedMotion(attempt);
  const squares = acceleration_mps2.reduce((sum, [x, y, z]) => sum + x * x + y * y + z * z, 0);
  const accuracy = 1 / (1 + deviation.rms_m / (acceptance.within_m ?? FAIR_M));
  const time = Math.min(1, durationOf(expert) / Math.max(duration_s, 1e-9));
  const economy = Math.min(1, 1 / Math.max(pathRatio, 1e-9));
  const missed: string[] = [];
  const { within_m, within_s, pathRatio: most } = acceptance;
  if (within_m !== undefined && deviation.max_m > within_m)
    missed.push(`It leaves the path by ${mm(deviation.max_m)} mm; ${mm(within_m)} mm are allowed.`);
  if (within_s !== undefined && duration_s > within_s)
    missed.push(`It takes ${duration_s.toFixed(1)} s; ${within_s.toFixed(1)} s are allowed.`);
  if (most !== undefined && pathRatio > most)
    missed.push(`Its path is ${pathRatio.toFixed(2)} times the expert's; ${most.toFixed(2)} are allowed.`);
  return {
    duration_s,
    length_m,
    deviation,
    pathRatio,
    unrest_mps2: Math.sqrt(squares / acceleration_mps2.length),
    score: (100 * (2 * accuracy + time + economy)) / 4,
    accepted: missed.length === 0,
    missed,
  };
}

const mm = (length_m: number): string => (length_m * 1000).toFixed(1);

/** The best of several attempts (row M-62): an accepted one before one that is not, then the higher score. */
export function bestAttempt(attempts: readonly Attempt[]): number {
  let best = -1;
  attempts.forEach((attempt, i) => {
    const other = attempts[best];
    const better =
      other === undefined ||
      (attempt.accepted && !other.accepted) ||
      (attempt.accepted === other.accepted && attempt.score > other.score);
    if (better) best = i;
  });
  return best;
}
