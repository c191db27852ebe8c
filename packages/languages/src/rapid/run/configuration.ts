import { linkPoses, identity, solveAll, type Pose, type Robot } from "@twincell/core";

/** cf1, cf4, cf6, cfx */
export type Confdata = readonly [number, number, number, number];

const dot = (a: readonly number[], b: readonly number[]): number => a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
const minus = (a: readonly number[], b: readonly number[]): number[] => [a[0]! - b[0]!, a[1]! - b[1]!, a[2]! - b[2]!];
const crossed = (a: readonly number[], b: readonly number[]): number[] => [
  a[1]! * b[2]! - a[2]! * b[1]!,
  a[2]! * b[0]! - a[0]! * b[2]!,
  a[0]! * b[1]! - a[1]! * b[0]!,
];

/**
 * Where the arm stands, read off its links: bit 2 the wrist centre is behind axis 1, bit 1 it is behind the lower arm
 * as the arm faces, bit 0 axis 5 is negative.
 */
export function octant(robot: Robot, q_rad: readonly number[]): number {
  const links = Array.from({ length: 7 }, () => identity<"base", "link">());
  linkPoses(robot.arm, q_rad, links);
  const facing = [Math.cos(q_rad[0]!), Math.sin(q_rad[0]!), 0];
  const across = [-Math.sin(q_rad[0]!), Math.cos(q_rad[0]!), 0];
  const shoulder = links[2]!.position;
  const elbow = links[3]!.position;
  const wrist = links[5]!.position;
  const isBehind = dot(minus(wrist, links[1]!.position), facing) < 0;
  const leans = dot(crossed(minus(elbow, shoulder), minus(wrist, elbow)), across) < 0;
  return (isBehind ? 4 : 0) + (leans ? 2 : 0) + (q_rad[4]! < 0 ? 1 : 0);
}

/** Arms whose wrist is a ball, of which cfx speaks. Of others the manual's words say nothing here. */
const HAS_OCTANTS: ReadonlySet<string> = new Set(["abb_irb120"]);

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
  baseFromFlange: Pose<"base", "flange">,
  near: readonly number[] | undefined,
  conf: Confdata | undefined,
): readonly number[] | undefined {
  const reach = solveAll(robot, baseFromFlange, near === undefined ? {} : { near });
  if (reach.kind !== "reached") return undefined;
  let best: readonly number[] | undefined;
  let least = Infinity;
  for (const { q_rad } of reach.solutions) {
    const q = [...q_rad];
    const way = near === undefined ? 0 : q.reduce((sum, angle, i) => sum + Math.abs(angle - near[i]!), 0);
    const beside =
      conf === undefined
        ? 0
        : [
            [0, 0],
            [3, 1],
            [5, 2],
          ].reduce((sum, [joint, k]) => {
            const gap = outside(q[joint!]!, conf[k!]!);
            return sum + (gap > BORDER_RAD ? gap : 0);
          }, 0) + (!HAS_OCTANTS.has(robot.id) || octant(robot, q) === conf[3] ? 0 : 2 * Math.PI);
    const cost = 1000 * beside + way;
    if (cost < least) {
      least = cost;
      best = q;
    }
  }
  return best;
}
