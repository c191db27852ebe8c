import type { ToolRecord } from "../document.ts";
import { partById, partNumbers } from "./index.ts";

/** What a tool weighs [kg]: as typed, else as its part of the library or its fingers weigh; undefined where unknown. */
export function toolMass({ mass_kg, shape, gripper }: ToolRecord): number | undefined {
  if (mass_kg !== undefined) return mass_kg;
  const kind = shape?.kind === "part" ? partById(shape.part) : undefined;
  if (kind !== undefined && shape?.kind === "part") return kind.mass_kg(partNumbers(kind, shape.parameters));
  return gripper?.mass_kg;
}
