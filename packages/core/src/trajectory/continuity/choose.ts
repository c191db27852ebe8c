import type { Robot } from "../../model/robot.ts";
import type { Move } from "../moves.ts";
import { ContinuitySolver, type Break, type Continuity, type Flip } from "./continuity.ts";

/** Which postures a path is driven in. */
export interface Choice {
  /** How the arm goes. */
  readonly way: Continuity;
  /**
   * Whether postures had to be chosen: a controller that takes the nearest one at every target would not go this way.
   */
  readonly chosen: boolean;
  /** Moves that no posture gets through unless the arm turns over somewhere before them, */
  readonly broken: readonly Break[];
  /** and where it would have to, at a standstill. */
  readonly turning: readonly Flip[];
}

/** Whether a move's posture is for the arm to choose: a joint move to a pose taught without a branch. */
export const isFree = (move: Move): boolean =>
  move.step.path === "ptp" && move.q_rad === undefined && move.branch === undefined;

/**
 * How bad a way is before time counts: paths nobody gets through, postures changed at a standstill or other than
 * taught, flips.
 */
function faults({ breaks, flips, otherwise }: Continuity): readonly [number, number, number] {
  const stood = flips.filter(({ kind }) => kind === "standstill").length;
  return [breaks.length, stood + otherwise.length, flips.length - stood];
}

function fewer(a: Continuity, b: Continuity): boolean {
  const [x, y] = [faults(a), faults(b)];
  const differs = x.findIndex((count, i) => count !== y[i]);
  return differs >= 0 && x[differs]! < y[differs]!;
}

/**
 * Chooses the postures of a whole path. Where the nearest posture at every target leads through without a flip, it is
 * taken: that is what controllers do by themselves. Else all postures are weighed, and chosen where fewer things go
 * wrong.
 *
 * @returns undefined where the path has nothing to choose and nothing to follow.
 */
export function chooseBranches(
  runs: readonly (readonly Move[])[],
  robot: Robot,
  start_rad: Float64Array,
  solver = new ContinuitySolver(robot),
): Choice | undefined {
  if (!runs.some(run => run.some(move => isFree(move) || move.step.path !== "ptp"))) return undefined;
  const nearest = solver.solve(runs, start_rad, { nearest: true });
  if (faults(nearest).every(count => count === 0)) return { way: nearest, chosen: false, broken: [], turning: [] };
  const best = solver.solve(runs, start_rad);
  const broken = best.breaks;
  const turned = broken.length > 0 ? solver.solve(runs, start_rad, { standstill: true }) : best;
  const turning = turned.flips.filter(({ kind }) => kind === "standstill");
  const way = fewer(turned, best) ? turned : best;
  const chosen = fewer(way, nearest);
  return { way: chosen ? way : nearest, chosen, broken, turning };
}

/** The same moves, with the posture that was chosen for each that is free. */
export function withChoice(moves: readonly Move[], { way, chosen }: Choice, first: number): readonly Move[] {
  if (!chosen) return moves;
  return moves.map((move, i) => {
    const configuration = isFree(move) ? way.ends[first + i] : undefined;
    return configuration === undefined ? move : { ...move, chosen_rad: configuration };
  });
}
