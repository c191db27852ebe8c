import { pose } from "../../spatial/pose.ts";
import type { Robot } from "../../model/robot.ts";
import { LINK_PROFILES } from "./forms/fanuc_lrmate200id.ts";
import { sectionOfData } from "../vendor-sections.ts";
import {
  ACCELERATIONS_ASSUMED,
  FROM_MEMORY,
  SHAPES_FITTED,
  TCP_SPEED_ASSUMED,
  TCP_SPEED_MPS,
  linkProfiles,
  inDegrees,
  joint,
  orthoParallel,
  turned,
} from "./write.ts";

/**
 * Joint 3 is counted against the upper arm. The pendant counts it against the horizon: J3 of the pendant = joint 3 −
 * joint 2. The controller counts from the height of axis 2.
 */
export const fanucLrmate200id: Robot = {
  id: "fanuc_lrmate200id",
  name: "FANUC LR Mate 200iD",
  vendor: "FANUC",
  vendorSection: sectionOfData({ kind: "fanuc" }),
  arm: {
    name: "FANUC LR Mate 200iD",
    joints: [
      joint("joint_1", [0, 0, 0.33], [0, 0, 1], inDegrees(-170, 170, 450)),
      joint("joint_2", [0.05, 0, 0], [0, 1, 0], inDegrees(-100, 145, 380)),
      joint("joint_3", [0, 0, 0.33], [0, -1, 0], inDegrees(-70, 205, 520)),
      joint("joint_4", [0, 0, 0.035], [-1, 0, 0], inDegrees(-190, 190, 550)),
      joint("joint_5", [0.335, 0, 0], [0, -1, 0], inDegrees(-125, 125, 545)),
      joint("joint_6", [0.08, 0, 0], [-1, 0, 0], inDegrees(-360, 360, 1000)),
    ],
    lastJointFromFlange: turned([0, 0, 0], [Math.PI, -Math.PI / 2, 0]),
  },
  family: orthoParallel([0.05, -0.035, 0, 0.33, 0.33, 0.335, 0.08], [0, 0, -1, 0, 0, 2], [1, 1, -1, -1, -1, -1]),
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: pose([0, 0, 0.33]),
  home_rad: [0, 0, 0, 0, -Math.PI / 2, 0],
  payload_kg: 7,
  payloadMax_kg: 7,
  reach_m: 0.717,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "wrist",
  repeatability_m: 20e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 25,
  form: linkProfiles(LINK_PROFILES, ["cover", "casting", "casting", "casting", "casting", "casting", "metal"]),
  paint: { casting: "#f2c21a", dark: "#24282a", cover: "#474c4e" },
  sources: {
    "lengths, limits, speeds":
      "ros-industrial/fanuc, lrmate200id_macro.xacro (BSD-3-Clause), which quotes FANUC B-83494EN/03.",
    "joint 3 against joint 2": "ros-industrial/fanuc, fanuc_driver robot_state.launch: J23_factor 1 for this model.",
    "payload, reach": "7 kg, 717 mm; 50 + 330 + √(335² + 35²) = 716.8 mm.",
    "mass, repeatability": FROM_MEMORY,
  },
  assumptions: [
    ACCELERATIONS_ASSUMED,
    TCP_SPEED_ASSUMED,
    SHAPES_FITTED,
    "The limits of joint 3 hold for the angle against the upper arm; the limit against the horizon is not published.",
  ],
  shapeError_m: 0.017,
};
