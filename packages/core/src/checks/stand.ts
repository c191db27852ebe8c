import type { CellGeometry, CellObject } from "../collision/cell.ts";
import { standLoad } from "../model/stand.ts";
import { compose, identity, inverse, transformPoint } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { everyStep } from "../program/walk.ts";
import { startOf, type CheckScene } from "./scene.ts";

/** A stand's face this near to the base is what the robot stands on [m]. */
const ON_TOP_M = 0.02;

/**
 * The object the robot stands on, of those that say what they carry: its box holds the base's origin, its face is
 * there.
 */
export function standOf({ worldFromBase, objects }: CellGeometry): CellObject | undefined {
  const baseFromWorld = inverse(worldFromBase);
  const place: Vector3 = [0, 0, 0];
  const at: Vector3 = [0, 0, 0];
  return objects.find(({ carries_kg, worldFromObject, mesh: { positions } }) => {
    if (carries_kg === undefined) return false;
    const baseFromObject = compose(baseFromWorld, worldFromObject, identity());
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < positions.length; i += 3) {
      place[0] = positions[i]!;
      place[1] = positions[i + 1]!;
      place[2] = positions[i + 2]!;
      transformPoint(baseFromObject, place, at);
      for (let axis = 0; axis < 3; axis++) {
        low[axis] = Math.min(low[axis]!, at[axis]!);
        high[axis] = Math.max(high[axis]!, at[axis]!);
      }
    }
    return low[0]! <= 0 && high[0]! >= 0 && low[1]! <= 0 && high[1]! >= 0 && Math.abs(high[2]!) <= ON_TOP_M;
  });
}

/**
 * Whether what the robot stands on carries it with every load of the program (row X-09).
 *
 * @returns what could not be judged, one sentence each.
 */
export function checkStand(scene: CheckScene, cell: CellGeometry, carried_kg = 0): string[] {
  const stand = standOf(cell);
  const { robot, program } = scene;
  const limit = stand?.carries_kg;
  if (stand === undefined || limit === undefined) return [];
  const judge = (step: string, payload_kg: number): boolean => {
    const load = standLoad(robot, payload_kg);
    if (load.kind === "unknown" || load.total_kg <= limit) return false;
    const both = payload_kg > 0 ? ` and carries ${payload_kg} kg, ${load.total_kg} kg together` : "";
    scene.add(step, "bad", {
      code: "stand.overloaded",
      value: load.total_kg,
      limit,
      unit: "kg",
      at_s: startOf(scene, step),
      repairs: [],
      sentence: `${robot.name} weighs ${load.robot_kg} kg${both}; ${stand.name} carries ${limit} kg.`,
    });
    return true;
  };
  const empty = standLoad(robot, carried_kg);
  const [first] = everyStep(program);
  if (empty.kind === "unknown") return [empty.sentence];
  if (first !== undefined && judge(first.id, carried_kg)) return [];
  for (const step of everyStep(program)) if (step.type === "payload") judge(step.id, step.mass_kg);
  return [];
}
