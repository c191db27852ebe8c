import { length, type PartKind } from "./kind.ts";
import { box } from "./piece.ts";

/** A taped carton with a label. */
export const CARTON: PartKind = {
  id: "carton",
  category: "load",
  role: "workpiece",
  color: "#b98a5a",
  friction: 0.5,
  parameters: [length("length", 0.4, 0.05, 1.2), length("width", 0.3, 0.05, 0.8), length("height", 0.25, 0.03, 1)],
  mass_kg: n => 100 * n.length! * n.width! * n.height!,
  pieces: ({ length: x = 0, width: y = 0, height: z = 0 }) => [
    box("cardboard", [0, 0, z / 2], [x, y, z]),
    box("tape", [0, 0, z + 0.0003], [x + 0.0012, 0.05, 0.0006], { only: "drawn" }),
    ...[-1, 1].map(side =>
      box("tape", [side * (x / 2 + 0.0003), 0, z - 0.03], [0.0006, 0.05, 0.06], { only: "drawn" }),
    ),
    box("white", [x * 0.22, -y / 2 - 0.0003, z * 0.55], [Math.min(0.12, x * 0.3), 0.0006, Math.min(0.08, z * 0.35)], {
      only: "drawn",
    }),
  ],
};
