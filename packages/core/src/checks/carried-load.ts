import type { CellGeometry } from "../collision/cell.ts";
import type { CarriedPart } from "./grasped-parts.ts";
import { motions, type CheckScene } from "./scene.ts";

/**
 * What the flange carries beyond what the robot lifts: the tool in use from the first motion on, and tool and part
 * together from where the gripper takes it (row X-07).
 *
 *   m = m_tool + m_part [kg], of those whose mass is known
 *
 * What a payload step says is judged by `checkPayload`. A robot of unknown payload is not judged.
 *
 * @param carried  parts that the program takes, as the collision check followed them.
 */
export function checkCarriedLoad(scene: CheckScene, cell: CellGeometry, carried: readonly CarriedPart[]): void {
  const { toolMass_kg = 0, objects } = cell;
  const first = motions(scene).next().value;
  if (first !== undefined && toolMass_kg > 0) judge(scene, first.step, first.start_s, toolMass_kg, "tool alone");
  for (const { id, taken_s } of carried) {
    const part = objects.find(object => object.id === id);
    const grasp = scene.layout.plan.segments.find(
      segment => segment.kind === "rest" && segment.gripperClosed && segment.start_s >= taken_s,
    );
    if (part?.mass_kg === undefined || grasp === undefined) continue;
    judge(scene, grasp.step, grasp.start_s, toolMass_kg + part.mass_kg, `tool with “${part.name}”`);
  }
}

function judge(scene: CheckScene, step: string, at_s: number, mass_kg: number, what: string): void {
  const { payload_kg, name } = scene.robot;
  if (payload_kg === undefined) return;
  const most_kg = scene.robot.payloadMax_kg ?? payload_kg;
  // Grams: sums of masses show the rounding of the machine otherwise.
  const load = Math.round(mass_kg * 1000) / 1000;
  const base = { value: load, unit: "kg", at_s, repairs: [] } as const;
  if (load > most_kg)
    scene.add(step, "bad", {
      ...base,
      code: "payload.too-heavy",
      limit: most_kg,
      sentence: `The ${what} weighs ${load} kg; the ${name} lifts at most ${most_kg} kg.`,
    });
  else if (load > payload_kg)
    scene.add(step, "warn", {
      ...base,
      code: "payload.reduced-speed",
      limit: payload_kg,
      sentence: `The ${what} weighs ${load} kg; above ${payload_kg} kg the ${name} moves at reduced speed.`,
    });
}
