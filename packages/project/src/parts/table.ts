import { length, type PartKind } from "./kind.ts";
import { box, corners, rod } from "./piece.ts";

const TOP_M = 0.04;
const LEG_M = 0.06;

/** A work table: beech top, four steel legs with feet, a frame below the top and a strut near the floor. */
export const TABLE: PartKind = {
  id: "table",
  category: "tables",
  role: "furniture",
  color: "#b98f5f",
  friction: 0.5,
  parameters: [length("length", 1.2, 0.3, 4), length("width", 0.8, 0.3, 2), length("height", 0.8, 0.2, 1.4)],
  mass_kg: n => 700 * n.length! * n.width! * TOP_M + 4 * 4 * n.height!,
  pieces: ({ length: x = 0, width: y = 0, height: z = 0 }) => {
    const legX = x / 2 - 0.07;
    const legY = y / 2 - 0.07;
    const under = z - TOP_M;
    return [
      box("wood", [0, 0, z - TOP_M / 2], [x, y, TOP_M]),
      ...corners(legX, legY, (cx, cy) => [
        box("paint-grey", [cx, cy, (under + 0.025) / 2], [LEG_M, LEG_M, under - 0.025]),
        rod("rubber", [cx, cy, 0.0125], 2, 0.035, 0.025),
      ]),
      ...[-1, 1].flatMap(side => [
        box("paint-grey", [0, side * legY, under - 0.04], [2 * legX - LEG_M, 0.03, 0.08]),
        box("paint-grey", [side * legX, 0, under - 0.04], [0.03, 2 * legY - LEG_M, 0.08]),
        box("paint-grey", [side * legX, 0, 0.2], [0.03, 2 * legY - LEG_M, 0.04]),
      ]),
    ];
  },
};
