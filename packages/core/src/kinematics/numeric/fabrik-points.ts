// FABRIK on bare points (rows ): n + 1 points, three numbers each, base first, and the n lengths between
// them.
// @see Aristidou & Lasenby, FABRIK: A fast, iterative solver for the Inverse Kinematics problem, Graphical Models 73(5)
// 2011.

/** The lengths between following points. */
export function lengthsOf(points: ArrayLike<number>): Float64Array {
  const lengths = new Float64Array(points.length / 3 - 1);
  for (let k = 0; k < lengths.length; k++) lengths[k] = apart(points, k, k + 1);
  return lengths;
}

/**
 * End effector to base: point `last` stays where it is, and each one before it is drawn along the line to its successor
 * until the link between them has its length again. The base comes loose.
 *
 * @param last  index of the point that stays; those after it are left alone.
 */
export function fabrikBackward(points: Float64Array, lengths: ArrayLike<number>, last: number): void {
  for (let k = last - 1; k >= 0; k--) draw(points, k, k + 1, lengths[k]!);
}

/**
 * Base to end effector: point 0 goes back to where the base stands, and each next one is drawn after it. Always the
 * last pass.
 */
export function fabrikForward(points: Float64Array, lengths: ArrayLike<number>, base: ArrayLike<number>): void {
  for (let axis = 0; axis < 3; axis++) points[axis] = base[axis]!;
  for (let k = 1; k <= lengths.length; k++) draw(points, k, k - 1, lengths[k - 1]!);
}

/** Distances of the end from the goal: before, and after each round of both passes. */
export interface FabrikPointsRun {
  readonly miss_m: readonly number[];
  readonly settled: boolean;
}

/**
 * Both passes, round after round, until a round improves by less than is worth it (row X-21).
 *
 * @param points          moved in place; ends with the base where it was and every link at its length.
 * @param goal            where the last point should be.
 * @param insignificant_m improvement that is none.
 */
export function fabrikPoints(
  points: Float64Array,
  lengths: ArrayLike<number>,
  goal: ArrayLike<number>,
  insignificant_m = 1e-9,
  most = 1000,
): FabrikPointsRun {
  const last = lengths.length;
  const base = points.slice(0, 3);
  const miss_m = [missOf(points, last, goal)];
  for (let round = 0; round < most; round++) {
    for (let axis = 0; axis < 3; axis++) points[3 * last + axis] = goal[axis]!;
    fabrikBackward(points, lengths, last);
    fabrikForward(points, lengths, base);
    const before = miss_m[round]!;
    const now = missOf(points, last, goal);
    miss_m.push(now);
    if (before - now < insignificant_m) return { miss_m, settled: true };
  }
  return { miss_m, settled: false };
}

const missOf = (points: Float64Array, last: number, goal: ArrayLike<number>): number =>
  Math.hypot(points[3 * last]! - goal[0]!, points[3 * last + 1]! - goal[1]!, points[3 * last + 2]! - goal[2]!);

/** Distance between points i and j of a row of points. */
export function apart(points: ArrayLike<number>, i: number, j: number): number {
  const x = points[3 * i]! - points[3 * j]!;
  const y = points[3 * i + 1]! - points[3 * j + 1]!;
  const z = points[3 * i + 2]! - points[3 * j + 2]!;
  return Math.sqrt(x * x + y * y + z * z);
}

/**
 * Moves point k onto the line to `anchor`, at that distance; points that coincide have no line, and the link then
 * stands along z.
 */
function draw(points: Float64Array, k: number, anchor: number, length: number): void {
  const now = apart(points, k, anchor);
  for (let axis = 0; axis < 3; axis++) {
    const from = points[3 * anchor + axis]!;
    points[3 * k + axis] =
      now > 1e-12 ? from + ((points[3 * k + axis]! - from) * length) / now : from + (axis === 2 ? length : 0);
  }
}
