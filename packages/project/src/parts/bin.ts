import { length, type PartKind } from "./kind.ts";
import { box } from "./piece.ts";

const WALL_M = 0.004;

/** An open plastic container with a rim. */
export const BIN: PartKind = {
  id: "bin",
  category: "load",
  role: "fixture",
  color: "#2f6db5",
  friction: 0.35,
  parameters: [length("length", 0.6, 0.1, 1.2), length("width", 0.4, 0.1, 1), length("height", 0.22, 0.05, 0.8)],
  mass_kg: n => 950 * WALL_M * (n.length! * n.width! + 2 * (n.length! + n.width!) * n.height!),
  pieces: ({ length: x = 0, width: y = 0, height: z = 0 }) => [
    box("paint-blue", [0, 0, WALL_M / 2], [x, y, WALL_M]),
    ...[-1, 1].flatMap(side => [
      box("paint-blue", [0, side * (y / 2 - WALL_M / 2), z / 2 + WALL_M / 2], [x, WALL_M, z - WALL_M]),
      box("paint-blue", [side * (x / 2 - WALL_M / 2), 0, z / 2 + WALL_M / 2], [WALL_M, y - 2 * WALL_M, z - WALL_M]),
      box("paint-blue", [0, side * (y / 2 + 0.006), z - 0.015], [x + 0.024, 0.012, 0.03]),
      box("paint-blue", [side * (x / 2 + 0.006), 0, z - 0.015], [0.012, y, 0.03]),
    ]),
  ],
};
