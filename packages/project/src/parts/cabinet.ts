import { length, type PartKind } from "./kind.ts";
import { box, rod } from "./piece.ts";

/** A controller cabinet with door, main switch and lamp. */
export const CABINET: PartKind = {
  id: "cabinet",
  category: "stands",
  role: "furniture",
  color: "#b9c0c5",
  friction: 0.4,
  parameters: [length("length", 0.7, 0.3, 2), length("width", 0.5, 0.3, 1), length("height", 1.5, 0.4, 2.2)],
  mass_kg: n => 180 * n.length! * n.width! * n.height!,
  pieces: ({ length: x = 0, width: y = 0, height: z = 0 }) => [
    box("black", [0, 0, 0.05], [x - 0.04, y - 0.04, 0.1]),
    box("white", [0, 0, 0.1 + (z - 0.1) / 2], [x, y, z - 0.1]),
    box("paint-grey", [0, -y / 2 - 0.008, 0.1 + (z - 0.1) / 2], [x - 0.06, 0.016, z - 0.18]),
    rod("black", [x / 2 - 0.07, -y / 2 - 0.03, z * 0.55], 2, 0.01, 0.16),
    rod("red", [x * 0.2, -y / 2 - 0.028, z * 0.8], 1, 0.025, 0.025),
    box("paint-yellow", [x * 0.2, -y / 2 - 0.018, z * 0.8], [0.08, 0.005, 0.08], { only: "drawn" }),
    box("glass", [-x * 0.18, -y / 2 - 0.018, z * 0.8], [0.16, 0.006, 0.1], { only: "drawn" }),
  ],
};
