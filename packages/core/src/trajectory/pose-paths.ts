import { compose, type Pose } from "../spatial/pose.ts";
import { distance, norm, scale, subtract } from "../spatial/vector.ts";
import { arcPath, curvePath, linePath, turnBetween, TURN_M_PER_RAD, type PosePath } from "./geometry.ts";
import type { Move } from "./moves.ts";

/** A blend or path shorter than this [m] is a stop without the wait: it would only add nodes. */
export const SHORTEST_M = 1e-7;

/** Where the TCP of move k is when it begins. */
const startOf = (moves: readonly Move[], k: number, startFlange: Pose<"base", "flange">): Pose<"base", "tcp"> =>
  compose(moves[k - 1]?.baseFromFlange ?? startFlange, moves[k]!.flangeFromTcp);

/**
 * The TCP path of move i, from its start to its target without blends; undefined for a circle through three points of
 * one line.
 *
 * @param moves        a run: moves that are passed into each other, since a spline leans on its neighbours.
 * @param startFlange  where the flange is when the run begins.
 */
export function posePathOf(
  moves: readonly Move[],
  i: number,
  startFlange: Pose<"base", "flange">,
): PosePath | undefined {
  const move = moves[i]!;
  const from = startOf(moves, i, startFlange);
  switch (move.step.path) {
    case "circ":
      return move.via === undefined
        ? linePath(from, move.baseFromTcp)
        : arcPath(from, move.via.position, move.baseFromTcp);
    case "spline":
      return splinePath(moves, i, from, startFlange);
    default:
      return linePath(from, move.baseFromTcp);
  }
}

/** Catmull-Rom through the points of consecutive splines, non-uniform: the tangent leans to the shorter side. */
function splinePath(
  moves: readonly Move[],
  i: number,
  from: Pose<"base", "tcp">,
  startFlange: Pose<"base", "flange">,
): PosePath {
  const move = moves[i]!;
  const to = move.baseFromTcp;
  const spline = (k: number): boolean =>
    moves[k]?.step.path === "spline" && moves[k].step.target.tool === move.step.target.tool;
  const before = spline(i - 1) ? startOf(moves, i - 1, startFlange) : undefined;
  const after = spline(i + 1) ? moves[i + 1]!.baseFromTcp : undefined;
  const length = span(from, to);
  if (length < SHORTEST_M) return linePath(from, to);
  const chord = twistOver(from, to, length);
  const t0 = before === undefined ? chord : meanTwist(before, from, to);
  const t1 = after === undefined ? chord : meanTwist(from, to, after);
  return curvePath(from, t0, to, t1, length);
}

const span = (a: Pose, b: Pose): number =>
  Math.max(distance(a.position, b.position), TURN_M_PER_RAD * norm(turnBetween(a.quaternion, b.quaternion)));

function twistOver(a: Pose, b: Pose, length: number): Float64Array {
  const v = scale(subtract(b.position, a.position), 1 / length);
  const w = scale(turnBetween(a.quaternion, b.quaternion), 1 / length);
  return Float64Array.of(...v, ...w);
}

/** Tangent at b of the parabola through a, b and c: the chords' slopes, each weighed by the other's length. */
function meanTwist(a: Pose, b: Pose, c: Pose): Float64Array {
  const before = span(a, b);
  const after = span(b, c);
  if (before < SHORTEST_M) return twistOver(b, c, after);
  if (after < SHORTEST_M) return twistOver(a, b, before);
  const t0 = twistOver(a, b, before);
  const t1 = twistOver(b, c, after);
  return t0.map((x, i) => (x * after + t1[i]! * before) / (before + after));
}
