import { length, type PartKind } from "./kind.ts";
import { ball, box, rod } from "./piece.ts";

/** A person with helmet and high-visibility clothes, standing. Shares of the height after common body measures. */
export const PERSON: PartKind = {
  id: "person",
  category: "safety",
  role: "fixture",
  color: "#f08a24",
  friction: 0.6,
  parameters: [length("height", 1.77, 1.4, 2.05)],
  mass_kg: n => 24 * n.height! ** 2,
  pieces: ({ height: z = 0 }) => [
    ...[-1, 1].flatMap(side => [
      box("black", [side * z * 0.055, -z * 0.022, z * 0.022], [z * 0.055, z * 0.15, z * 0.044]),
      rod("fabric-dark", [side * z * 0.055, 0, z * 0.17], 2, z * 0.032, z * 0.27),
      rod("fabric-dark", [side * z * 0.055, 0, z * 0.39], 2, z * 0.042, z * 0.2),
      rod("fabric-orange", [side * z * 0.135, 0, z * 0.7], 2, z * 0.026, z * 0.22),
      rod("fabric-orange", [side * z * 0.14, -z * 0.01, z * 0.53], 2, z * 0.021, z * 0.15),
      ball("skin", [side * z * 0.14, -z * 0.015, z * 0.44], z * 0.024),
      ball("fabric-orange", [side * z * 0.128, 0, z * 0.8], z * 0.032),
    ]),
    rod("fabric-dark", [0, 0, z * 0.48], 2, z * 0.085, z * 0.06),
    rod("fabric-orange", [0, 0, z * 0.665], 2, z * 0.095, z * 0.31),
    rod("white", [0, 0, z * 0.6], 2, z * 0.0958, z * 0.02),
    rod("white", [0, 0, z * 0.7], 2, z * 0.0958, z * 0.02),
    rod("skin", [0, 0, z * 0.85], 2, z * 0.03, z * 0.06),
    ball("skin", [0, 0, z * 0.92], z * 0.06),
    ball("white", [0, 0, z * 0.937], z * 0.063),
    rod("white", [0, -z * 0.012, z * 0.94], 2, z * 0.078, z * 0.008),
  ],
};
