import { solveAll } from "../kinematics/inverse.ts";
import { isInsideWorkspace } from "../kinematics/workspace.ts";
import type { Robot } from "../model/robot.ts";
import type { Program } from "../program/program.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { layOutProgram } from "../trajectory/layout.ts";
import { explainReach } from "../kinematics/explain.ts";
import { placedMoves } from "./repair/path-fit.ts";

/** What a robot makes of one taught point (row X-35). */
export interface ReachPoint {
  readonly step: string;
  readonly name?: string;
  /** Of the tool, in the world [m]. */
  readonly position_m: Vector3;
  /** Postures that bring the tool there inside every limit; 1 or 0 for a point taught as joint angles. */
  readonly postures: number;
  /** In the best of them: the joint nearest to a limit, from 1, and how far it is from it [rad; m of a slide]. */
  readonly room?: { readonly joint: number; readonly value: number };
  /** Why there is none. */
  readonly sentence?: string;
}
export interface ReachReport {
  readonly robot: string;
  readonly points: readonly ReachPoint[];
  readonly reached: number;
  /** Of the points that are reached: the least room that the best posture of one has [rad; m of a slide]. */
  readonly leastRoom?: { readonly step: string; readonly joint: number; readonly value: number };
}

/**
 * Which of its taught points a robot reaches from where it stands, in how many postures and with how much room: the
 * points alone, neither the way between them nor what stands there. Rounds of a loop count once.
 */
export function reachReport(
  program: Program,
  robot: Robot,
  worldFromBase: Pose<"world", "base"> = identity(),
): ReachReport {
  const seen = new Set<string>();
  const points: ReachPoint[] = [];
  for (const { written, move } of placedMoves(layOutProgram(program, robot, { worldFromBase }))) {
    const [x, y, z] = compose(worldFromBase, move.baseFromTcp).position;
    const key = `${written} ${[x, y, z].map(value => value.toFixed(6)).join(" ")}`;
    if (seen.has(key)) continue;
    seen.add(key);
    const { name } = move.step;
    const about = { step: written, ...(name === undefined ? {} : { name }), position_m: [x, y, z] as Vector3 };
    if (move.q_rad !== undefined) {
      points.push({ ...about, ...ofAngles(robot, move.q_rad) });
      continue;
    }
    const reach = solveAll(robot, move.baseFromFlange);
    if (reach.kind !== "reached") {
      points.push({ ...about, postures: 0, sentence: explainReach(reach) });
      continue;
    }
    const rooms = reach.solutions.map(({ q_rad }) => roomOf(robot, q_rad));
    const room = rooms.reduce((best, each) => (each.value > best.value ? each : best));
    points.push({ ...about, postures: reach.solutions.length, room });
  }
  const reached = points.filter(({ postures }) => postures > 0);
  const least = reached
    .flatMap(({ step, room }) => (room === undefined ? [] : [{ step, ...room }]))
    .reduce<ReachReport["leastRoom"]>((so, each) => (so === undefined || each.value < so.value ? each : so), undefined);
  return {
    robot: robot.id,
    points,
    reached: reached.length,
    ...(least === undefined ? {} : { leastRoom: least }),
  };
}

function ofAngles(robot: Robot, q_rad: ArrayLike<number>): Pick<ReachPoint, "postures" | "room" | "sentence"> {
  const room = roomOf(robot, q_rad);
  if (room.value < 0) return { postures: 0, sentence: `Joint ${room.joint} is taught beyond its limit.` };
  if (!isInsideWorkspace(robot, q_rad)) return { postures: 0, sentence: "The arm is taught beyond its workspace." };
  return { postures: 1, room };
}

/** The joint that is nearest to a limit, and its distance from it; negative beyond. */
function roomOf({ arm }: Robot, q_rad: ArrayLike<number>): { readonly joint: number; readonly value: number } {
  let joint = 1;
  let value = Infinity;
  for (const [j, { limits }] of arm.joints.entries()) {
    const room = Math.min(limits.upper_rad - q_rad[j]!, q_rad[j]! - limits.lower_rad);
    if (room >= value) continue;
    value = room;
    joint = j + 1;
  }
  return { joint, value };
}

/** The report as a table for a spreadsheet: lengths in mm, angles in degrees, one line a point. */
export function reachTable({ points }: ReachReport): string {
  const cell = (value: string): string => (/[",\n]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value);
  const line = (values: readonly (string | number)[]): string => values.map(value => cell(String(value))).join(",");
  return `${[
    line(["step", "name", "x_mm", "y_mm", "z_mm", "reached", "postures", "nearest joint", "room", "why not"]),
    ...points.map(({ step, name = "", position_m, postures, room, sentence = "" }) =>
      line([
        step,
        name,
        ...position_m.map(value => (value * 1000).toFixed(1)),
        postures > 0 ? "yes" : "no",
        postures,
        room === undefined ? "" : room.joint,
        room === undefined ? "" : `${((room.value * 180) / Math.PI).toFixed(1)}`,
        sentence,
      ]),
    ),
  ].join("\n")}\n`;
}
