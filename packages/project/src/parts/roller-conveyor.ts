import { length, type PartKind } from "./kind.ts";
import { box, rod, spread } from "./piece.ts";

const ROLLER_M = 0.05;
const PROFILE_M = [0.04, 0.12] as const;

/** A driven roller conveyor: rollers between two side profiles, legs with feet and struts, a motor below. */
export const ROLLER_CONVEYOR: PartKind = {
  id: "roller-conveyor",
  category: "conveyors",
  role: "fixture",
  color: "#9aa3aa",
  friction: 0.5,
  conveys: true,
  parameters: [
    length("length", 1.6, 0.5, 8),
    length("width", 0.5, 0.2, 1.2),
    length("height", 0.75, 0.25, 1.4),
    length("pitch", 0.075, 0.06, 0.2),
    { id: "speed", quantity: "speed", value: 0.25, min: 0, max: 2 },
  ],
  mass_kg: n => 45 * n.length! * (0.5 + n.width!),
  pieces: ({ length: x = 0, width: y = 0, height: z = 0, pitch = 0.075 }) => {
    const side = y / 2 + PROFILE_M[0] / 2;
    const axle = z - ROLLER_M / 2;
    const legs = spread(Math.max(2, Math.round(x / 1.2) + 1), -x / 2 + 0.12, x / 2 - 0.12);
    const under = z - PROFILE_M[1];
    return [
      ...spread(Math.max(2, Math.floor((x - 0.06) / pitch)), -x / 2 + 0.04, x / 2 - 0.04).map(at =>
        rod("steel", [at, 0, axle], 1, ROLLER_M / 2, y - 0.006),
      ),
      ...[-1, 1].flatMap(sign => [
        box("aluminium", [0, sign * side, z - PROFILE_M[1] / 2 - 0.004], [x, PROFILE_M[0], PROFILE_M[1]]),
        box("black", [0, sign * (side + PROFILE_M[0] / 2 + 0.0004), z - 0.07], [x - 0.01, 0.0008, 0.01], {
          only: "drawn",
        }),
      ]),
      ...legs.flatMap(at => [
        ...[-1, 1].flatMap(sign => [
          box("aluminium", [at, sign * side, (under + 0.03) / 2], [0.08, PROFILE_M[0], under - 0.03]),
          rod("rubber", [at, sign * side, 0.015], 2, 0.04, 0.03),
        ]),
        box("aluminium", [at, 0, Math.min(0.28, under / 2)], [0.04, y, 0.04]),
      ]),
      box("paint-grey", [x * 0.25, 0, under - 0.06], [0.22, 0.14, 0.12]),
      rod("paint-grey", [x * 0.25 - 0.2, 0, under - 0.06], 0, 0.055, 0.18),
    ];
  },
};
