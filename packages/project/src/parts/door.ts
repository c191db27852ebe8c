import { post, wirePanel } from "./fence.ts";
import { length, type PartKind } from "./kind.ts";
import { box, rod } from "./piece.ts";

/** A guarded door: a wire panel on hinges, with handle and interlock switch. */
export const DOOR: PartKind = {
  id: "door",
  category: "safety",
  role: "wall",
  color: "#f2b100",
  friction: 0.4,
  parameters: [length("width", 1, 0.6, 2), length("height", 2, 1, 2.6)],
  mass_kg: n => 20 * n.width! * n.height!,
  pieces: ({ width: x = 0, height: z = 0 }) => [
    ...post(-x / 2 + 0.03, z),
    ...post(x / 2 - 0.03, z),
    ...wirePanel(0, x - 0.15, z),
    ...[0.35, z - 0.35].map(at => rod("steel", [-x / 2 + 0.068, 0, at], 2, 0.012, 0.12)),
    box("red", [x / 2 - 0.03, -0.055, z * 0.55], [0.05, 0.05, 0.16]),
    box("paint-yellow", [x / 2 - 0.11, -0.03, z * 0.55], [0.06, 0.04, 0.1]),
    rod("black", [x / 2 - 0.12, -0.05, z * 0.5], 2, 0.012, 0.18),
    box("paint-yellow", [0, -0.014, z * 0.72], [0.22, 0.004, 0.22], { only: "drawn" }),
    box("black", [0, -0.017, z * 0.72], [0.03, 0.003, 0.13], { only: "drawn" }),
  ],
};
