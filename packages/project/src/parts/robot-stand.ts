import { length, type PartKind } from "./kind.ts";
import { box, rod } from "./piece.ts";

/** A welded pedestal for a robot: column, foot and head plate, ribs, anchors. */
export const ROBOT_STAND: PartKind = {
  id: "robot-stand",
  category: "stands",
  role: "furniture",
  color: "#3a4147",
  friction: 0.4,
  carries_kg: 1000,
  parameters: [length("height", 0.5, 0.1, 1.5), length("width", 0.5, 0.3, 1)],
  mass_kg: n => 7850 * (2 * n.width! ** 2 * 0.02 + 0.02 * n.width! * n.height!),
  pieces: ({ height: z = 0, width: x = 0 }) => {
    const plate = 0.025;
    return [
      box("paint-grey", [0, 0, plate / 2], [x, x, plate]),
      rod("paint-grey", [0, 0, z / 2], 2, x * 0.3, z - 2 * plate),
      rod("paint-grey", [0, 0, z - plate / 2], 2, x * 0.42, plate),
      ...[0, 1, 2, 3].map(i => {
        const a = (i * Math.PI) / 2;
        return box(
          "paint-grey",
          [Math.cos(a) * x * 0.36, Math.sin(a) * x * 0.36, plate + z * 0.14],
          [x * 0.14, 0.014, z * 0.28],
          {
            turn_rad: a,
          },
        );
      }),
      ...[-1, 1].flatMap(sx =>
        [-1, 1].map(sy => rod("steel", [sx * x * 0.42, sy * x * 0.42, plate + 0.012], 2, 0.016, 0.024)),
      ),
    ];
  },
};
