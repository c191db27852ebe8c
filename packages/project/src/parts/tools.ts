import { fromAxisAngle, pose, type Vector3 } from "@twincell/core";
import { length, type PartKind, type PartNumbers } from "./kind.ts";
import { ball, box, corners, rod, spread, type PartPiece } from "./piece.ts";

/** What a tool touches with is no solid: it may meet the work piece [m]. */
const SOFT_M = 0.012;

/**
 * The linkage of the Robotiq 2F-85 in the plane of its fingers, from the ROS description ros2_robotiq_gripper: the
 * pivot of the knuckle, the pivot of the finger tip seen from it, and the pad and the end of the tip seen from that.
 * Five joints mimic the knuckle so that the tips keep upright: gap and height follow one angle q.
 *
 *   gap = 2 (pivot_x + tip_x cos q − tip_z sin q − pad)         height = pivot_z + tip_x sin q + tip_z cos q + end
 */
export const LINKAGE = { pivot_x: 0.0306, pivot_z: 0.0549, tip_x: 0.03716, tip_z: 0.04343, pad: 0.02526, end: 0.05067 };
const OPEN_M = 0.085;
/** The knuckle with the pads together, as the maker states it [rad]. */
export const FULLY_CLOSED_RAD = 0.8;

/** The knuckle angle of a 2F-85 at a gap between its pads [rad]: 0 wide open, 0.8 closed. */
export function knuckleAngle(gap_m: number): number {
  const { pivot_x, tip_x, tip_z, pad } = LINKAGE;
  const reach = Math.hypot(tip_x, tip_z);
  const wanted = gap_m / 2 + pad - pivot_x;
  return Math.max(0, Math.acos(Math.min(1, Math.max(-1, wanted / reach))) - Math.atan2(tip_z, tip_x));
}
/** How far the finger tips of a 2F-85 are from its flange at that gap [m]: 149 mm open, 163 mm closed. */
export function tipHeight(gap_m: number): number {
  const q = knuckleAngle(gap_m);
  const { pivot_z, tip_x, tip_z, end } = LINKAGE;
  return pivot_z + tip_x * Math.sin(q) + tip_z * Math.cos(q) + end;
}

const FINGER: Vector3 = [0.012, 0.022, 0.045];
const straight = (z_m: number) => ({ flangeFromTcp: pose<"flange", "tcp">([0, 0, z_m]) });

const TWO_FINGERS: PartKind = {
  id: "two-fingers",
  category: "tools",
  role: "fixture",
  color: "#2b3136",
  friction: 0.5,
  parameters: [length("width", OPEN_M, 0, OPEN_M)],
  mass_kg: () => 0.921,
  pieces: ({ width = OPEN_M }) => {
    const tip = tipHeight(width);
    const knuckle = 0.0306 + 0.02;
    return [
      rod("black", [0, 0, 0.006], 2, 0.0375, 0.012),
      box("black", [0, 0, 0.05], [0.072, 0.058, 0.078]),
      box("aluminium", [0, 0, 0.09], [0.06, 0.04, 0.012]),
      ...[-1, 1].flatMap((side): PartPiece[] => [
        box("paint-grey", [side * knuckle, 0, 0.075], [0.018, 0.03, 0.05]),
        box("aluminium", [side * (width / 2 + FINGER[0] / 2 + 0.006), 0, tip - 0.055], [0.016, 0.024, 0.05]),
        box("rubber", [side * (width / 2 + FINGER[0] / 2), 0, tip - FINGER[2] / 2], FINGER, { only: "drawn" }),
      ]),
    ];
  },
  tool: ({ width = OPEN_M }) => ({
    ...straight(tipHeight(width)),
    gripper: {
      open_m: OPEN_M,
      closed_m: 0,
      force_N: 130,
      finger_m: FINGER,
      beyond_m: 0,
      speed_mps: 0.15,
      friction: 0.6,
      mass_kg: 0.921,
    },
  }),
};

const CUP_M = 0.035;
const cups = ({ length: x = 0, width: y = 0, count = 4 }: PartNumbers): readonly (readonly [number, number])[] => {
  const along = Math.max(1, Math.round(count / 2));
  return spread(along, -x / 2 + 0.03, x / 2 - 0.03).flatMap(at =>
    [-1, 1].map(side => [at, side * (y / 2 - 0.03)] as const),
  );
};
const VACUUM: PartKind = {
  id: "vacuum-cups",
  category: "tools",
  role: "fixture",
  color: "#8d979f",
  friction: 0.7,
  parameters: [
    length("length", 0.3, 0.1, 1.2),
    length("width", 0.2, 0.1, 0.8),
    { id: "count", quantity: "plain", value: 6, min: 2, max: 24 },
  ],
  mass_kg: ({ length: x = 0, width: y = 0, count = 0 }) => 0.9 + 2.2 * (2 * x + y) + 0.06 * count,
  pieces: numbers => {
    const { length: x = 0, width: y = 0 } = numbers;
    return [
      rod("paint-grey", [0, 0, 0.008], 2, 0.045, 0.016),
      rod("aluminium", [0, 0, 0.035], 2, 0.022, 0.05),
      box("aluminium", [0, 0, 0.07], [0.04, y, 0.02]),
      ...[-1, 1].map(side => box("aluminium", [0, side * (y / 2 - 0.03), 0.07], [x, 0.03, 0.02])),
      box("paint-blue", [0, 0, 0.1], [0.05, 0.04, 0.04], { only: "drawn" }),
      ...cups(numbers).flatMap(([u, v]): PartPiece[] => [
        rod("steel", [u, v, 0.1], 2, 0.006, 0.05),
        rod("rubber", [u, v, 0.126], 2, CUP_M * 0.34, 0.018, { only: "drawn" }),
        rod("rubber", [u, v, 0.141], 2, CUP_M / 2, 0.012, { only: "drawn" }),
      ]),
    ];
  },
  tool: () => straight(0.147),
};

/** The torch is bent by 45°: its wire leaves along the tool axis. */
const BEND_RAD = Math.PI / 4;
const TORCH: PartKind = {
  id: "torch",
  category: "tools",
  role: "fixture",
  color: "#3a4147",
  friction: 0.3,
  parameters: [length("height", 0.32, 0.2, 0.6)],
  mass_kg: () => 2.4,
  pieces: ({ height: z = 0 }) => {
    const neck = z - 0.12;
    const along = (t: number): Vector3 => [Math.sin(BEND_RAD) * t, 0, neck + Math.cos(BEND_RAD) * t];
    return [
      rod("black", [0, 0, 0.01], 2, 0.04, 0.02),
      box("paint-grey", [0, 0, 0.06], [0.07, 0.06, 0.08]),
      rod("black", [0, 0, (0.1 + neck) / 2], 2, 0.017, neck - 0.1),
      ...spread(7, 0, 0.075).map(t => ball("black", along(t), 0.017)),
      ...spread(6, 0.08, 0.125).map(t => ball("aluminium", along(t), 0.011)),
      ...spread(4, 0.13, 0.145).map(t => ({ ...ball("steel", along(t), 0.002), only: "drawn" as const })),
      rod("rubber", [0, 0.03, 0.13], 2, 0.009, 0.12, { only: "drawn" }),
    ];
  },
  tool: ({ height: z = 0 }) => ({
    flangeFromTcp: pose<"flange", "tcp">(
      [Math.sin(BEND_RAD) * 0.147, 0, z - 0.12 + Math.cos(BEND_RAD) * 0.147],
      fromAxisAngle([0, 1, 0], BEND_RAD),
    ),
  }),
};

const SPINDLE: PartKind = {
  id: "spindle",
  category: "tools",
  role: "fixture",
  color: "#8d979f",
  friction: 0.3,
  parameters: [length("height", 0.26, 0.18, 0.5)],
  mass_kg: ({ height: z = 0 }) => 1.2 + 9 * (z - 0.08),
  pieces: ({ height: z = 0 }) => [
    rod("paint-grey", [0, 0, 0.01], 2, 0.05, 0.02),
    ...corners(0.034, 0.034, (x, y) => [rod("steel", [x, y, 0.022], 2, 0.004, 0.008, { only: "drawn" })]),
    rod("aluminium", [0, 0, 0.02 + (z - 0.08) / 2], 2, 0.04, z - 0.08),
    rod("black", [0, 0, z - 0.052], 2, 0.024, 0.016),
    rod("steel", [0, 0, z - 0.036], 2, 0.012, 0.02),
    rod("steel", [0, 0, z - 0.013], 2, 0.004, 0.026, { only: "drawn" }),
    rod("rubber", [0.034, 0, 0.07], 2, 0.008, 0.1, { only: "drawn" }),
  ],
  tool: ({ height: z = 0 }) => straight(z),
};

const POINTER: PartKind = {
  id: "pointer",
  category: "tools",
  role: "fixture",
  color: "#c98f45",
  friction: 0.3,
  parameters: [length("height", 0.15, 0.08, 0.5)],
  mass_kg: ({ height: z = 0 }) => 0.2 + 1.6 * z,
  pieces: ({ height: z = 0 }) => [
    rod("aluminium", [0, 0, 0.006], 2, 0.03, 0.012),
    rod("steel", [0, 0, (0.012 + z - 0.04) / 2], 2, 0.01, z - 0.052),
    rod("steel", [0, 0, z - 0.04 + (0.04 - SOFT_M) / 2], 2, 0.004, 0.04 - SOFT_M),
    rod("steel", [0, 0, z - SOFT_M / 2], 2, 0.0015, SOFT_M, { only: "drawn" }),
  ],
  tool: ({ height: z = 0 }) => straight(z),
};

const GLUE_GUN: PartKind = {
  id: "glue-gun",
  category: "tools",
  role: "fixture",
  color: "#3a4147",
  friction: 0.3,
  parameters: [length("height", 0.24, 0.18, 0.4)],
  mass_kg: () => 1.8,
  pieces: ({ height: z = 0 }) => [
    rod("black", [0, 0, 0.008], 2, 0.04, 0.016),
    box("paint-grey", [0, 0, 0.05], [0.06, 0.05, 0.07]),
    rod("aluminium", [0, 0, (0.085 + z - 0.05) / 2], 2, 0.022, z - 0.135),
    rod("steel", [0, 0, z - 0.04], 2, 0.009, 0.02),
    rod("steel", [0, 0, z - 0.021], 2, 0.004, 0.018),
    rod("white", [0, 0, z - SOFT_M / 2], 2, 0.0012, SOFT_M, { only: "drawn" }),
    rod("rubber", [0.036, 0, 0.07], 2, 0.009, 0.12, { only: "drawn" }),
  ],
  tool: ({ height: z = 0 }) => straight(z),
};

/** Tools in the frame of the flange, z out of it. */
export const TOOLS: readonly PartKind[] = [TWO_FINGERS, VACUUM, TORCH, SPINDLE, POINTER, GLUE_GUN];
