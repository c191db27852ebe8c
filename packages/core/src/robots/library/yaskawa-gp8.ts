import { pose } from "../../spatial/pose.ts";
import type { Robot } from "../../model/robot.ts";
import { CASTINGS } from "./forms/yaskawa_gp8.ts";
import { sectionOfData } from "../vendor-sections.ts";
import {
  ACCELERATIONS_ASSUMED,
  FROM_MEMORY,
  SHAPES_FITTED,
  TCP_SPEED_ASSUMED,
  TCP_SPEED_MPS,
  linkProfiles,
  inRadians,
  joint,
  orthoParallel,
  turned,
} from "./write.ts";

/** Axes S, L, U, R, B, T. The controller counts from the height of axis 2. */
export const yaskawaGp8: Robot = {
  id: "yaskawa_gp8",
  name: "Yaskawa GP8",
  vendor: "Yaskawa",
  vendorSection: {
    ...sectionOfData({ kind: "yaskawa" }),
    pulses: { perRadian: [1340, 1340, 1340, 1000, 1000, 620].map(value => (value * 180) / Math.PI), source: "example" },
  },
  arm: {
    name: "Yaskawa GP8",
    joints: [
      joint("joint_1_s", [0, 0, 0.33], [0, 0, 1], inRadians(-2.967, 2.967, 7.9412)),
      joint("joint_2_l", [0.04, 0, 0], [0, 1, 0], inRadians(-1.1344, 2.5307, 6.7495)),
      joint("joint_3_u", [0, 0, 0.345], [0, -1, 0], inRadians(-1.2217, 3.3161, 9.0757)),
      joint("joint_4_r", [0.34, 0, 0.04], [-1, 0, 0], inRadians(-3.3161, 3.3161, 9.5993)),
      joint("joint_5_b", [0, 0, 0], [0, -1, 0], inRadians(-2.3561, 2.3561, 9.5993)),
      joint("joint_6_t", [0, 0, 0], [-1, 0, 0], inRadians(-6.2944, 6.2944, 17.4845)),
    ],
    // Rounded in the source; kept, so that its poses are met to the last digit.
    lastJointFromFlange: turned([0.08, 0, 0], [3.1415926, -1.570796, 0]),
  },
  family: orthoParallel(
    [0.04, -0.04, 0, 0.33, 0.345, 0.34, 0.08],
    [0, 0, -1, 0, 0, 0],
    [1, 1, -1, -1, -1, -1],
    pose([0, 0, 0], [1.6339744818294477e-7, -2.6794896585028275e-8, 0.9999999999999862, 0]),
  ),
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: pose([0, 0, 0.33]),
  home_rad: [0, 0, 0, 0, -Math.PI / 2, 0],
  payload_kg: 8,
  payloadMax_kg: 8,
  reach_m: 0.727,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "wrist",
  repeatability_m: 10e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 32,
  form: linkProfiles(CASTINGS, ["cover", "casting", "casting", "casting", "casting", "casting", "metal"]),
  paint: { casting: "#2a4fb0", dark: "#20262c", cover: "#39424a" },
  sources: {
    "lengths, limits, speeds, flange":
      "ros-industrial/motoman, gp8_macro.xacro (BSD), which quotes the vendor's data sheet; lengths again in robotkinematicscatalogue 1.1.2, Yaskawa_GP8.",
    "payload, reach": "8 kg, 727 mm; 40 + 345 + √(340² + 40²) = 727.3 mm.",
    "mass, repeatability": FROM_MEMORY,
  },
  assumptions: [
    ACCELERATIONS_ASSUMED,
    TCP_SPEED_ASSUMED,
    SHAPES_FITTED,
    "The upper limit of axis U is counted from another zero in some tables; here it is 190° from the level forearm.",
  ],
  shapeError_m: 0.014,
};
