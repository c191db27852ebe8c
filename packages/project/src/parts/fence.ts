import { length, type PartKind } from "./kind.ts";
import { box, spread, type PartPiece } from "./piece.ts";

const POST_M = 0.06;
const OFF_FLOOR_M = 0.12;
const WIRE_M = 0.0044;

/** A post on a foot plate with four bolts. */
export const post = (x_m: number, height_m: number): readonly PartPiece[] => [
  box("paint-yellow", [x_m, 0, height_m / 2 + 0.005], [POST_M, POST_M, height_m - 0.01]),
  box("paint-yellow", [x_m, 0, 0.005], [0.14, 0.14, 0.01]),
  ...[-1, 1].flatMap(sx =>
    [-1, 1].map(sy => box("steel", [x_m + sx * 0.052, sy * 0.052, 0.014], [0.018, 0.018, 0.008], { only: "drawn" })),
  ),
];

/** A frame with a wire mesh; what collides is the panel as a whole. */
export function wirePanel(x_m: number, length_m: number, height_m: number): readonly PartPiece[] {
  const from = OFF_FLOOR_M;
  const high = height_m - from - 0.02;
  const middle = from + high / 2;
  const wires = spread(Math.max(2, Math.round(length_m / 0.045)), x_m - length_m / 2 + 0.03, x_m + length_m / 2 - 0.03);
  const rows = spread(Math.max(2, Math.round(high / 0.11)), from + 0.03, from + high - 0.03);
  return [
    box("black", [x_m, 0, middle], [length_m, 0.02, high], { only: "solid" }),
    ...[-1, 1].flatMap(side => [
      box("black", [x_m + side * (length_m / 2 - 0.015), 0, middle], [0.03, 0.02, high], { only: "drawn" }),
      box("black", [x_m, 0, middle + side * (high / 2 - 0.015)], [length_m, 0.02, 0.03], { only: "drawn" }),
    ]),
    ...wires.map(x => box("black", [x, 0.003, middle], [WIRE_M, WIRE_M, high], { only: "drawn" })),
    ...rows.map(z => box("black", [x_m, -0.002, z], [length_m, WIRE_M, WIRE_M], { only: "drawn" })),
  ];
}

/** A run of guard fence: panels of at most 1 m between posts. */
export const FENCE: PartKind = {
  id: "fence",
  category: "safety",
  role: "wall",
  color: "#f2b100",
  friction: 0.4,
  parameters: [length("length", 1, 0.3, 12), length("height", 2, 1, 2.6)],
  mass_kg: n => 14 * n.length! * n.height!,
  pieces: ({ length: x = 0, height: z = 0 }) => {
    const count = Math.max(1, Math.ceil(x / 1.2));
    const posts = spread(count + 1, -x / 2 + POST_M / 2, x / 2 - POST_M / 2);
    return [
      ...posts.flatMap(at => post(at, z)),
      ...posts.slice(1).flatMap((at, i) => wirePanel((at + posts[i]!) / 2, at - posts[i]! - POST_M - 0.01, z)),
    ];
  },
};
