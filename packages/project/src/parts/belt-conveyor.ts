import { length, type PartKind } from "./kind.ts";
import { box, rod, spread } from "./piece.ts";

const DRUM_M = 0.04;

/** A belt conveyor: rubber belt over two drums, side profiles, legs with feet, a drive. */
export const BELT_CONVEYOR: PartKind = {
  id: "belt-conveyor",
  category: "conveyors",
  role: "fixture",
  color: "#3d444b",
  friction: 0.8,
  conveys: true,
  parameters: [
    length("length", 1.6, 0.4, 8),
    length("width", 0.4, 0.1, 1.2),
    length("height", 0.7, 0.2, 1.4),
    { id: "speed", quantity: "speed", value: 0.25, min: 0, max: 2 },
  ],
  mass_kg: n => 35 * n.length! * (0.4 + n.width!),
  pieces: ({ length: x = 0, width: y = 0, height: z = 0 }) => {
    const run = x - 2 * DRUM_M;
    const side = y / 2 + 0.015;
    const under = z - 2 * DRUM_M - 0.02;
    return [
      box("rubber", [0, 0, z - DRUM_M], [run, y, 2 * DRUM_M]),
      ...[-1, 1].map(end => rod("rubber", [(end * run) / 2, 0, z - DRUM_M], 1, DRUM_M, y)),
      ...[-1, 1].map(sign =>
        box("aluminium", [0, sign * side, z - DRUM_M - 0.015], [x - 0.02, 0.03, 2 * DRUM_M + 0.01]),
      ),
      ...spread(Math.max(2, Math.round(x / 1.4) + 1), -x / 2 + 0.15, x / 2 - 0.15).flatMap(at => [
        ...[-1, 1].flatMap(sign => [
          box("aluminium", [at, sign * side, (under + 0.03) / 2], [0.05, 0.03, under - 0.03]),
          rod("rubber", [at, sign * side, 0.015], 2, 0.035, 0.03),
        ]),
        box("aluminium", [at, 0, Math.min(0.2, under / 2)], [0.03, y, 0.03]),
      ]),
      box("paint-blue", [x / 2 - 0.16, -side - 0.085, z - DRUM_M - 0.02], [0.12, 0.14, 0.1]),
    ];
  },
};
