import { length, type PartKind } from "./kind.ts";
import { box, corners, rod, spread } from "./piece.ts";

/** A fixture table: slotted steel plate on four legs. */
export const STEEL_TABLE: PartKind = {
  id: "steel-table",
  category: "tables",
  role: "fixture",
  color: "#8d979f",
  friction: 0.3,
  parameters: [length("length", 1.2, 0.3, 4), length("width", 0.8, 0.3, 2), length("height", 0.75, 0.2, 1.2)],
  mass_kg: n => 7850 * n.length! * n.width! * 0.015 + 6 * 4 * n.height!,
  pieces: ({ length: x = 0, width: y = 0, height: z = 0 }) => [
    box("aluminium", [0, 0, z - 0.05], [x, y, 0.1]),
    ...spread(Math.max(2, Math.round(y / 0.1)), -y / 2 + 0.05, y / 2 - 0.05).map(at =>
      box("black", [0, at, z + 0.0004], [x - 0.02, 0.014, 0.0008], { only: "drawn" }),
    ),
    ...corners(x / 2 - 0.08, y / 2 - 0.08, (cx, cy) => [
      box("paint-grey", [cx, cy, (z - 0.1 + 0.03) / 2], [0.09, 0.09, z - 0.13]),
      rod("steel", [cx, cy, 0.015], 2, 0.05, 0.03),
    ]),
  ],
};
