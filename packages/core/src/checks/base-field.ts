import { PoseFit } from "../kinematics/pose-fit.ts";
import type { Robot } from "../model/robot.ts";
import type { Program } from "../program/program.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import { conjugate, rotate } from "../spatial/quaternion.ts";
import { radians } from "../spatial/units.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { arcPath, geometryScratch, linePath, posePoint } from "../trajectory/geometry.ts";
import { layOutProgram } from "../trajectory/layout.ts";
import { checkProgram, type CheckOptions } from "./check.ts";
import { placedMoves, type PlacedMove } from "./repair/path-fit.ts";
import { shiftedPose } from "./repair/repair-search.ts";

/** A place the base could stand at, as a shift from where it stands now, along the floor [m, in the world]. */
export interface BaseSquare {
  readonly x_m: number;
  readonly y_m: number;
  /** Points of the program that are reached from there. */
  readonly reached: number;
  /** Those of them that a posture reaches with `ROOMY_RAD` to every joint limit. */
  readonly roomy: number;
}
export interface BaseField {
  /** Points of the program that stay where they are in the world. */
  readonly points: number;
  /** Side of a square [m]. */
  readonly square_m: number;
  readonly squares: readonly BaseSquare[];
  /** Whether all squares are there: a coarse field comes first. */
  readonly complete: boolean;
}
export interface SuggestedBase extends BaseSquare {
  /** What the check of the whole program says with the robot there. */
  readonly duration_s: number;
  readonly clearance_m: number | null;
}

/** A posture with this much to every joint limit has room. */
export const ROOMY_RAD = radians(20);
const HALF_M = 1.2;
const SQUARE_M = 0.1;
/** Squares of one side of a coarse one. */
const COARSE = [4, 2, 1] as const;
const MOST_POSES = 160;
/** Points looked at on a straight line or an arc. */
const LOOKS = 9;
const MOST_CHECKED = 10;
/** Suggestions that are checked stand at least so far from each other [m]. */
const APART_M = 0.2;

/**
 * From how many places along the floor a program could be carried out (its reach only: neither collision nor the way
 * between the points), coarse to fine. Points taught as joint angles move with the robot and do not count.
 *
 * @param worldFromBase  where the robot stands now.
 */
export function* baseField(program: Program, robot: Robot, worldFromBase: Pose<"world", "base">): Generator<BaseField> {
  const poses = thinned(fixedPoses(program, robot, worldFromBase));
  const reach = new PoseFit(robot);
  const roomy = new PoseFit(robot, { room_rad: ROOMY_RAD });
  const baseFromWorld = conjugate(worldFromBase.quaternion);
  const shifted = poses.map(({ quaternion }) => ({ position: [0, 0, 0] as Vector3, quaternion }));
  const look = (x_m: number, y_m: number): BaseSquare => {
    const [dx, dy, dz] = rotate(baseFromWorld, [x_m, y_m, 0]);
    let reached = 0;
    let withRoom = 0;
    for (const [i, { position }] of poses.entries()) {
      const at = shifted[i]!;
      at.position[0] = position[0] - dx;
      at.position[1] = position[1] - dy;
      at.position[2] = position[2] - dz;
      if (!reach.fits(at)) continue;
      reached++;
      if (roomy.fits(at)) withRoom++;
    }
    return { x_m, y_m, reached, roomy: withRoom };
  };
  const known = new Map<string, BaseSquare>();
  const half = Math.round(HALF_M / SQUARE_M);
  for (const step of COARSE) {
    const squares: BaseSquare[] = [];
    for (let i = -half; i <= half; i += step)
      for (let j = -half; j <= half; j += step) {
        const key = `${i} ${j}`;
        const square = known.get(key) ?? look(i * SQUARE_M, j * SQUARE_M);
        known.set(key, square);
        squares.push(square);
      }
    yield { points: poses.length, square_m: step * SQUARE_M, squares, complete: step === 1 };
  }
}

/**
 * The place of a field from which the whole program can be carried out fastest, among those with the most points and
 * the most room: each is checked with everything that stands in the cell. Undefined where none of them is good, or
 * where the program has no point that stays in the world.
 */
export function suggestBase(
  field: BaseField,
  program: Program,
  robot: Robot,
  options: CheckOptions & { readonly worldFromBase: Pose<"world", "base"> },
  onProgress?: (share: number) => void,
): SuggestedBase | undefined {
  if (field.points === 0) return undefined;
  let best: SuggestedBase | undefined;
  const candidates = spread(field);
  for (const [i, square] of candidates.entries()) {
    onProgress?.(i / candidates.length);
    const worldFromBase = shiftedPose(options.worldFromBase, [square.x_m, square.y_m, 0]);
    const { verdict } = checkProgram(program, robot, {
      ...options,
      worldFromBase,
      ...(options.cell === undefined ? {} : { cell: { ...options.cell, worldFromBase } }),
    });
    if (!verdict.ok || (best !== undefined && verdict.duration_s >= best.duration_s)) continue;
    best = { ...square, duration_s: verdict.duration_s, clearance_m: verdict.clearance_m };
  }
  return best;
}

/** The best squares that are not neighbours, the best first: all points, then room, then the shortest way. */
function spread({ squares, points }: BaseField): readonly BaseSquare[] {
  const chosen: BaseSquare[] = [];
  const all = squares.filter(({ reached }) => reached === points);
  const away = ({ x_m, y_m }: BaseSquare): number => Math.hypot(x_m, y_m);
  for (const square of all.toSorted((a, b) => b.roomy - a.roomy || away(a) - away(b))) {
    if (chosen.length >= MOST_CHECKED) break;
    if (chosen.every(({ x_m, y_m }) => Math.hypot(x_m - square.x_m, y_m - square.y_m) >= APART_M - 1e-9))
      chosen.push(square);
  }
  return chosen;
}

/** Poses of the flange, seen from the base as it stands, that stay in the world when the base moves. */
function fixedPoses(
  program: Program,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
): readonly Pose<"base", "flange">[] {
  const geometry = geometryScratch();
  const seen = new Set<string>();
  return placedMoves(layOutProgram(program, robot, { worldFromBase })).flatMap(placed => {
    const { written, move } = placed;
    // Rounds of a loop go to the same places.
    const key = `${written} ${move.baseFromFlange.position.map(value => value.toFixed(5)).join(" ")}`;
    if (move.q_rad !== undefined || seen.has(key)) return [];
    seen.add(key);
    const path = pathOf(placed);
    if (path === undefined) return [move.baseFromFlange];
    return Array.from({ length: LOOKS }, (_, k) => {
      const at = identity<"base", "tcp">();
      posePoint(path, (path.length * k) / (LOOKS - 1), at, geometry);
      return compose(at, move.tcpFromFlange);
    });
  });
}

/** The way to a target where both its ends stay in the world. */
function pathOf({ move, from, before }: PlacedMove) {
  if (move.step.path === "ptp" || from === undefined || before?.move.q_rad !== undefined) return undefined;
  if (move.step.path === "circ" && move.via !== undefined) return arcPath(from, move.via.position, move.baseFromTcp);
  return linePath(from, move.baseFromTcp);
}

function thinned(poses: readonly Pose<"base", "flange">[]): readonly Pose<"base", "flange">[] {
  if (poses.length <= MOST_POSES) return poses;
  return Array.from({ length: MOST_POSES }, (_, i) => poses[Math.floor((i * poses.length) / MOST_POSES)]!);
}

/** Where the best base is, as a shift. */
export const baseShift = ({ x_m, y_m }: BaseSquare): Vector3 => [x_m, y_m, 0];
