import type { Vector3 } from "@twincell/core";
import { FULLY_CLOSED_RAD, LINKAGE } from "./tools.ts";

/** A box of a link [m, frame of the link]. */
interface LinkBox {
  readonly centre_m: Vector3;
  readonly size_m: Vector3;
}
/** Links and joints of a gripper with a linkage, for a URDF. */
export interface GripperTree {
  readonly name: string;
  readonly links: readonly { readonly name: string; readonly mass_kg: number; readonly boxes: readonly LinkBox[] }[];
  readonly joints: readonly {
    readonly name: string;
    readonly kind: "revolute" | "fixed";
    readonly parent: string;
    readonly child: string;
    readonly at_m: Vector3;
    readonly axis?: Vector3;
    readonly limits?: {
      readonly lower: number;
      readonly upper: number;
      readonly speed: number;
      readonly effort: number;
    };
    readonly mimic?: { readonly joint: string; readonly multiplier: number };
  }[];
}

const MASTER = "left_knuckle_joint";
/** The inner knuckle hangs beside the outer one [m], from the ROS description ros2_robotiq_gripper. */
const INNER: Vector3 = [0.0127, 0, 0.06142];
const LIMITS = { lower: 0, upper: FULLY_CLOSED_RAD, speed: 0.5, effort: 50 };

/**
 * The two fingers of a 2F-85 as links and joints: the left knuckle is driven, five joints mimic it, so that the tips
 * keep upright. All turn about −y of the flange; at 0 the gripper is open by 85 mm.
 *
 *   right = −left;   inner knuckles as their outer ones;   tips against their knuckles
 */
export function twoFingerTree(): GripperTree {
  const { pivot_x, pivot_z, tip_x, tip_z, pad, end } = LINKAGE;
  const joints: GripperTree["joints"][number][] = [];
  const links: GripperTree["links"][number][] = [
    { name: "gripper_base", mass_kg: 0.663, boxes: [{ centre_m: [0, 0, 0.045], size_m: [0.072, 0.058, 0.09] }] },
  ];
  for (const [side, s] of [
    ["left", 1],
    ["right", -1],
  ] as const) {
    const turning = (name: string, parent: string, at_m: Vector3, multiplier: number): void => {
      const joint = `${side}_${name}_joint`;
      joints.push({
        name: joint,
        kind: "revolute",
        parent,
        child: `${side}_${name}`,
        at_m,
        axis: [0, -1, 0],
        // A joint that follows goes where it is taken: its range is that of the driven one, turned round where it is.
        limits: multiplier < 0 ? { ...LIMITS, lower: -LIMITS.upper, upper: 0 } : LIMITS,
        ...(joint === MASTER ? {} : { mimic: { joint: MASTER, multiplier } }),
      });
    };
    turning("knuckle", "gripper_base", [s * pivot_x, 0, pivot_z], s);
    turning("inner_knuckle", "gripper_base", [s * INNER[0], 0, INNER[2]], s);
    turning("finger_tip", `${side}_knuckle`, [s * tip_x, 0, tip_z], -s);
    links.push(
      {
        name: `${side}_knuckle`,
        mass_kg: 0.056,
        boxes: [{ centre_m: [(s * tip_x) / 2, 0, tip_z / 2], size_m: [0.02, 0.024, 0.05] }],
      },
      {
        name: `${side}_inner_knuckle`,
        mass_kg: 0.03,
        boxes: [{ centre_m: [(s * tip_x) / 2, 0, tip_z / 2], size_m: [0.008, 0.024, 0.05] }],
      },
      {
        name: `${side}_finger_tip`,
        mass_kg: 0.043,
        boxes: [{ centre_m: [s * (0.006 - pad), 0, end - 0.0225], size_m: [0.012, 0.022, 0.045] }],
      },
    );
  }
  return { name: "two_fingers_85", links, joints };
}
