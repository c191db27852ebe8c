import { solveAll, type Pose, type Robot } from "@twincell/core";
import { armPoints, type ShownAxes } from "../../parser/index.ts";

const DEG = 180 / Math.PI;

/** cf1, cf4, cf6, cfx */
export type Confdata = readonly [number, number, number, number];

/**
 * Where the arm stands, read off its links: bit 2 the wrist centre is behind axis 1, bit 1 it is behind the lower arm
 * as the arm faces, bit 0 axis 5 is negative.
 */
export function octant(robot: Robot, axes: ShownAxes, q_rad: readonly number[]): number {
  const { ahead_m, folded } = armPoints(robot, axes, q_rad);
  return (ahead_m < 0 ? 4 : 0) + (folded < 0 ? 2 : 0) + (axes.degrees(q_rad)[4]! < 0 ? 1 : 0);
}

/** How far an angle is from a quarter turn [rad]; 0 inside. */
function outside(angle_rad: number, quarter: number): number {
  const from = (quarter * Math.PI) / 2;
  const to = from + Math.PI / 2;
  return Math.max(from - angle_rad, angle_rad - to, 0);
}

/** An angle a little beyond its quarter is still taken for it: a text has few digits [rad]. */
const BORDER_RAD = 1e-4;

/**
 * The joint angles in that configuration, those of least travel among several. Of angles in no such configuration the
 * ones that are least beside it: the controller asks the same of its operator.
 */
export function solved(
  robot: Robot,
  axes: ShownAxes,
  baseFromFlange: Pose<"base", "flange">,
  near: readonly number[] | undefined,
  conf: Confdata | undefined,
): readonly number[] | undefined {
  const reach = solveAll(robot, baseFromFlange, near === undefined ? {} : { near });
  if (reach.kind !== "reached") return undefined;
  // Of a wrist whose axes do not meet the manual's words for cfx say nothing here.
  const isSpherical = robot.family.kind === "ortho-parallel";
  let best: readonly number[] | undefined;
  let least = Infinity;
  for (const { q_rad } of reach.solutions) {
    const q = [...q_rad];
    const shown = axes.degrees(q);
    const way = near === undefined ? 0 : q.reduce((sum, angle, i) => sum + Math.abs(angle - near[i]!), 0);
    const beside =
      conf === undefined
        ? 0
        : [
            [0, 0],
            [3, 1],
            [5, 2],
          ].reduce((sum, [joint, k]) => {
            const gap = outside(shown[joint!]! / DEG, conf[k!]!);
            return sum + (gap > BORDER_RAD ? gap : 0);
          }, 0) + (!isSpherical || octant(robot, axes, q) === conf[3] ? 0 : 2 * Math.PI);
    const cost = 1000 * beside + way;
    if (cost < least) {
      least = cost;
      best = q;
    }
  }
  return best;
}
