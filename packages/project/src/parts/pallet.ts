import { length, type PartKind } from "./kind.ts";
import { box, spread } from "./piece.ts";

const BOARD_M = 0.022;

/** A flat pallet as EUR 1 (EN 13698-1): five boards above, three stringers, nine blocks, three boards below. */
export const PALLET: PartKind = {
  id: "pallet",
  category: "load",
  role: "fixture",
  color: "#c9a168",
  friction: 0.45,
  parameters: [length("length", 1.2, 0.4, 1.6), length("width", 0.8, 0.4, 1.2), length("height", 0.144, 0.1, 0.2)],
  mass_kg: n => (25 * n.length! * n.width!) / 0.96,
  pieces: ({ length: x = 0, width: y = 0, height: z = 0 }) => {
    const block = z - 3 * BOARD_M;
    const wide = 0.145;
    const rows = spread(3, -y / 2 + wide / 2, y / 2 - wide / 2);
    return [
      ...spread(5, -y / 2 + wide / 2, y / 2 - wide / 2).map((at, i) =>
        box("wood", [0, at, z - BOARD_M / 2], [x, i % 2 === 0 ? wide : 0.1, BOARD_M]),
      ),
      ...spread(3, -x / 2 + wide / 2, x / 2 - wide / 2).flatMap(at => [
        box("wood", [at, 0, z - 1.5 * BOARD_M], [wide, y, BOARD_M]),
        ...rows.map(row => box("wood", [at, row, BOARD_M + block / 2], [wide, 0.1, block])),
      ]),
      ...rows.map(row => box("wood", [0, row, BOARD_M / 2], [x, 0.1, BOARD_M])),
    ];
  },
};
