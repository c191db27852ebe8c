import { pose } from "../../spatial/pose.ts";
import type { SerialArm } from "../../model/arm.ts";
import { familyOf } from "../family.ts";
import type { Robot } from "../../model/robot.ts";
import { LINK_PROFILES } from "./forms/kuka_lbr_iiwa_14_r820.ts";
import {
  ACCELERATIONS_ASSUMED,
  FROM_MEMORY,
  SHAPES_FITTED,
  TCP_SPEED_ASSUMED,
  TCP_SPEED_MPS,
  linkProfiles,
  inRadians,
  joint,
} from "./write.ts";

const arm: SerialArm = {
  name: "KUKA LBR iiwa 14 R820",
  joints: [
    joint("joint_a1", [0, 0, 0], [0, 0, 1], inRadians(-2.9668, 2.9668, 1.4834)),
    joint("joint_a2", [-0.00043624, 0, 0.36], [0, 1, 0], inRadians(-2.0942, 2.0942, 1.4834)),
    joint("joint_a3", [0, 0, 0], [0, 0, 1], inRadians(-2.9668, 2.9668, 1.7452)),
    joint("joint_a4", [0.00043624, 0, 0.42], [0, -1, 0], inRadians(-2.0942, 2.0942, 1.3089)),
    joint("joint_a5", [0, 0, 0], [0, 0, 1], inRadians(-2.9668, 2.9668, 2.2688)),
    joint("joint_a6", [0, 0, 0.4], [0, 1, 0], inRadians(-2.0942, 2.0942, 2.356)),
    joint("joint_a7", [0, 0, 0], [0, 0, 1], inRadians(-3.0541, 3.0541, 2.356)),
  ],
  lastJointFromFlange: pose([0, 0, 0.126]),
};

/** Seven joints: shoulder, elbow and wrist of three, one and three axes. */
export const kukaLbrIiwa14: Robot = {
  id: "kuka_lbr_iiwa_14_r820",
  name: "KUKA LBR iiwa 14 R820",
  vendor: "KUKA",
  arm,
  family: familyOf(arm),
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: pose(),
  home_rad: [0, Math.PI / 6, 0, -Math.PI / 2, 0, Math.PI / 3, 0],
  payload_kg: 14,
  payloadMax_kg: 14,
  reach_m: 0.82,
  reachMeasuredFrom: "axis-2",
  reachMeasuredTo: "wrist",
  repeatability_m: 150e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 29.9,
  form: linkProfiles(LINK_PROFILES, [
    "casting",
    "casting",
    "casting",
    "casting",
    "casting",
    "casting",
    "casting",
    "metal",
  ]),
  paint: { casting: "#d4d6d5", dark: "#53585b", cover: "#e8731c" },
  sources: {
    "lengths, limits, speeds":
      "ros-industrial/kuka_experimental, lbr_iiwa_14_r820_macro.xacro (Apache-2.0); its sideways steps of 0.436 mm are kept.",
    "payload, reach": "14 kg, 820 mm = 420 + 400 from the shoulder to the wrist.",
    "mass, repeatability": FROM_MEMORY,
  },
  assumptions: [
    ACCELERATIONS_ASSUMED,
    TCP_SPEED_ASSUMED,
    SHAPES_FITTED,
    "Joint torques are not in the source and not checked.",
  ],
  shapeError_m: 0.016,
};
