import { length, type PartKind } from "./kind.ts";
import { box } from "./piece.ts";

/** Two columns of a light curtain with their windows towards each other. What it senses is a sensor of the cell. */
export const LIGHT_CURTAIN: PartKind = {
  id: "light-curtain",
  category: "safety",
  role: "fixture",
  color: "#f2b100",
  friction: 0.4,
  parameters: [length("width", 1.25, 0.4, 6), length("height", 1.2, 0.3, 2)],
  mass_kg: n => 16 * n.height!,
  pieces: ({ width: x = 0, height: z = 0 }) =>
    [-1, 1].flatMap(side => [
      box("paint-yellow", [side * (x / 2), 0, z / 2 + 0.005], [0.06, 0.07, z - 0.01]),
      box("black", [side * (x / 2 - 0.0305), 0, z / 2 + 0.02], [0.001, 0.03, z - 0.16], { only: "drawn" }),
      box("paint-grey", [side * (x / 2), 0, 0.005], [0.16, 0.16, 0.01]),
      box("glass", [side * (x / 2), -0.036, z - 0.04], [0.02, 0.003, 0.02], { only: "drawn" }),
    ]),
};
