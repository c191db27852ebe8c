import { length, type PartKind } from "./kind.ts";
import { box, rod } from "./piece.ts";

/** A clamping fixture: base plate with pins, stops and two toggle clamps. */
export const FIXTURE: PartKind = {
  id: "fixture",
  category: "tables",
  role: "fixture",
  color: "#8d979f",
  friction: 0.3,
  parameters: [length("length", 0.4, 0.15, 1.5), length("width", 0.3, 0.15, 1), length("height", 0.12, 0.08, 0.4)],
  mass_kg: n => 2700 * n.length! * n.width! * 0.03,
  pieces: ({ length: x = 0, width: y = 0, height: z = 0 }) => [
    box("aluminium", [0, 0, 0.01], [x, y, 0.02]),
    ...[-1, 1].flatMap(side => [
      box("steel", [side * (x / 2 - 0.03), y / 2 - 0.03, 0.02 + z * 0.2], [0.03, 0.03, z * 0.4]),
      rod("steel", [side * (x / 2 - 0.06), -y / 2 + 0.05, 0.04], 2, 0.008, 0.04),
      box("paint-grey", [side * (x / 2 - 0.05), -y * 0.05, 0.02 + z * 0.25], [0.04, 0.05, z * 0.5]),
      box("steel", [side * (x / 2 - 0.05), y * 0.06, z * 0.72], [0.02, y * 0.3, 0.015]),
      rod("red", [side * (x / 2 - 0.05), -y * 0.1, z * 0.8], 2, 0.014, z * 0.4),
    ]),
  ],
};
