import type { Robot } from "./robot.ts";

/** What a stand has to carry (row X-09) [kg]; unknown where the mass of the robot is not published. */
export type StandLoad =
  | { readonly kind: "known"; readonly robot_kg: number; readonly payload_kg: number; readonly total_kg: number }
  | { readonly kind: "unknown"; readonly sentence: string };

/** The robot with a load on its flange; with its nominal payload unless said. Cables and controller are not in it. */
export function standLoad(robot: Robot, payload_kg = robot.payload_kg): StandLoad {
  const { mass_kg, name } = robot;
  const unknown = (what: string): StandLoad => ({
    kind: "unknown",
    sentence: `The ${what} of ${name} is not published: whether its stand carries it is not judged.`,
  });
  if (mass_kg === undefined) return unknown("mass");
  if (payload_kg === undefined) return unknown("payload");
  return { kind: "known", robot_kg: mass_kg, payload_kg, total_kg: mass_kg + payload_kg };
}
