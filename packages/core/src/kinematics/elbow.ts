import type { Robot } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { wrapAngle } from "../spatial/units.ts";
import { candidates, settle, solverScratch, type SolverScratch } from "./candidates.ts";
import { LIMIT_SLACK_RAD, nearestTurn } from "./turns.ts";

/** A stretch of elbow angles, from ≤ to [rad]; it may run over π, so `to` may exceed it. */
export interface ElbowInterval {
  readonly from_rad: number;
  readonly to_rad: number;
}

/** Steps around the elbow's circle: 2°. A stretch that is shorter may be passed over. */
const STEPS = 180;
const HALVINGS = 40;

/**
 * Where on its circle the elbow of a seven-joint arm may stand at a pose with all joints inside their limits: the
 * circle is sampled every 2° and every border halved down to rounding. Any of the eight branches will do.
 *
 * @returns stretches in ascending order from −π; one of length 2π where every elbow angle will do; none where none will
 *   or the arm has no elbow angle.
 */
export function elbowIntervals(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  scratch: SolverScratch = solverScratch(),
): ElbowInterval[] {
  if (robot.family.kind !== "spherical-seven") return [];
  const step = (2 * Math.PI) / STEPS;
  const can = Array.from({ length: STEPS }, (_, i) =>
    fits(robot, baseFromFlange, -Math.PI + i * step, undefined, scratch),
  );
  if (can.every(Boolean)) return [{ from_rad: -Math.PI, to_rad: Math.PI }];
  const first = can.indexOf(false);
  const found: ElbowInterval[] = [];
  if (!can.includes(true)) return found;
  for (let i = 1; i <= STEPS; i++) {
    if (can[(first + i - 1) % STEPS]! || !can[(first + i) % STEPS]!) continue;
    let last = i;
    while (can[(first + last + 1) % STEPS]!) last++;
    const at = (k: number): number => -Math.PI + (first + k) * step;
    const from = border(robot, baseFromFlange, at(i), at(i - 1), scratch);
    const to = border(robot, baseFromFlange, at(last), at(last + 1), scratch);
    const wrapped = wrapAngle(from);
    found.push({ from_rad: wrapped, to_rad: wrapped + (to - from) });
    i = last;
  }
  return found.sort((a, b) => a.from_rad - b.from_rad);
}

/**
 * The elbow angle nearest to a wanted one at which some branch keeps inside the limits; undefined when none is found.
 * Sampled every 2° to both sides; the border that is met is halved down to rounding. Allocates nothing.
 */
export function nearestElbow(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  wanted_rad: number,
  near: ArrayLike<number> | undefined,
  scratch: SolverScratch,
): number | undefined {
  if (robot.family.kind !== "spherical-seven") return undefined;
  const step = (2 * Math.PI) / STEPS;
  for (let k = 0; k <= STEPS / 2; k++) {
    for (let side = 1; side >= -1; side -= 2) {
      const elbow = wanted_rad + side * k * step;
      if (!fits(robot, baseFromFlange, elbow, near, scratch)) continue;
      return k === 0 ? elbow : wrapAngle(border(robot, baseFromFlange, elbow, elbow - side * step, scratch));
    }
  }
  return undefined;
}

/** Between an elbow angle that fits and one that does not: the last that fits. */
function border(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  fitting: number,
  other: number,
  scratch: SolverScratch,
): number {
  let good = fitting;
  let bad = other;
  for (let k = 0; k < HALVINGS; k++) {
    const middle = 0.5 * (good + bad);
    if (fits(robot, baseFromFlange, middle, undefined, scratch)) good = middle;
    else bad = middle;
  }
  return good;
}

/** Whether some branch of that elbow angle meets the pose with all joints inside their limits. */
function fits(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  elbow_rad: number,
  near: ArrayLike<number> | undefined,
  scratch: SolverScratch,
): boolean {
  const joints = robot.arm.joints;
  const n = joints.length;
  const count = candidates(robot, baseFromFlange, near, elbow_rad, scratch);
  for (let s = 0; s < count; s++) {
    let inside = true;
    for (let j = 0; j < n && inside; j++) {
      const { lower_rad, upper_rad } = joints[j]!.limits;
      const turned = nearestTurn(scratch.raw[n * s + j]!, 0.5 * (lower_rad + upper_rad), lower_rad, upper_rad);
      inside = turned >= lower_rad - LIMIT_SLACK_RAD;
    }
    if (inside && settle(robot, baseFromFlange, s, scratch)) return true;
  }
  return false;
}
