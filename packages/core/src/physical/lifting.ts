import type { Robot } from "../model/robot.ts";
import type { Refusal } from "../outcomes.ts";

/** Masses agree below this [kg]: what a scale of this class tells apart. */
const SCALE_KG = 1e-6;

/**
 * Whether a robot may lift a part (row X-07): the part and the gripper together are the payload, and the maker's figure
 * itself is allowed (E-25). Known before the part leaves the table (row X-55).
 *
 * @returns the refusal, or undefined when it may.
 */
export function liftRefusal(
  robot: Robot,
  part: { readonly name: string; readonly mass_kg: number },
  gripper_kg: number,
): Refusal | undefined {
  const total_kg = part.mass_kg + gripper_kg;
  const most_kg = robot.payloadMax_kg;
  if (most_kg === undefined || total_kg <= most_kg + SCALE_KG) return undefined;
  const with_ =
    gripper_kg > 0
      ? ` with the gripper (${inKilograms(gripper_kg)}) weighs ${inKilograms(total_kg)}`
      : ` weighs ${inKilograms(part.mass_kg)}`;
  return {
    code: "physics.payload",
    value: total_kg,
    limit: most_kg,
    sentence: `${robot.name} carries at most ${inKilograms(most_kg)}; “${part.name}”${gripper_kg > 0 ? ` (${inKilograms(part.mass_kg)})` : ""}${with_}.`,
    hint: `Take a part that is ${inKilograms(total_kg - most_kg)} lighter, or a robot that carries more.`,
  };
}

const inKilograms = (mass_kg: number): string => `${Number(mass_kg.toFixed(3))} kg`;
