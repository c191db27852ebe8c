import { pose } from "../../spatial/pose.ts";
import type { Robot } from "../../model/robot.ts";
import { LINK_PROFILES } from "./forms/staubli_rx160.ts";
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
  solid,
} from "./write.ts";

/** All joints 0 stands straight up; the controller counts from the shoulder. */
export const staubliRx160: Robot = {
  id: "staubli_rx160",
  name: "Stäubli RX160",
  vendor: "Stäubli",
  vendorSection: sectionOfData({ kind: "staubli-val3" }),
  arm: {
    name: "Stäubli RX160",
    joints: [
      joint("joint_1", [0, 0, 0.55], [0, 0, 1], inDegrees(-160, 160, 200, 692)),
      joint("joint_2", [0.15, 0, 0], [0, 1, 0], inDegrees(-137.5, 137.5, 200, 574)),
      joint("joint_3", [0, 0, 0.825], [0, 1, 0], inDegrees(-150, 150, 255, 242)),
      joint("joint_4", [0, 0, 0], [0, 0, 1], inDegrees(-270, 270, 315, 58)),
      joint("joint_5", [0, 0, 0.625], [0, 1, 0], inDegrees(-105, 120, 360, 29)),
      joint("joint_6", [0, 0, 0.11], [0, 0, 1], inDegrees(-270, 270, 870, 29)),
    ],
    lastJointFromFlange: pose(),
  },
  family: orthoParallel([0.15, 0, 0, 0.55, 0.825, 0.625, 0.11], [0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: pose([0, 0, 0.55]),
  home_rad: [0, 0, Math.PI / 2, 0, Math.PI / 2, 0],
  payload_kg: 20,
  payloadMax_kg: 20,
  reach_m: 1.71,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "flange",
  repeatability_m: 50e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 248,
  masses: [
    solid(45.357763, [0.085479, -0.002547, -0.040488], [0.839141, 1.030146, 1.064698, 0.022637, 0.162457, 0.027416]),
    solid(51.266495, [-2e-6, 0.264164, 0.347704], [5.2728, 5.536809, 0.486191, 1e-5, 1.7e-5, -0.008261]),
    solid(19.754401, [-0.000255, 0.016478, -0.003819], [0.249388, 0.21178, 0.238488, -0.004901, 0.004825, 0.000574]),
    solid(15.287896, [-0.015515, 0.000164, 0.340348], [0.331593, 0.320895, 0.086557, 5.5e-5, -0.010688, 5.8e-5]),
    solid(0.548088, [0, -0.000347, 0.023671], [0.000876, 0.000889, 0.000412, 0, 0, 5e-6]),
    solid(0.038484, [-0.000245, 0, -0.007626], [1.1e-5, 1.1e-5, 2.1e-5, 0, 0, 0]),
  ],
  form: linkProfiles(LINK_PROFILES, ["casting", "casting", "casting", "casting", "casting", "cover", "metal"]),
  paint: { casting: "#eaa50c", dark: "#272c30", cover: "#87847f" },
  sources: {
    "lengths, limits, speeds, torques, masses":
      "ros-industrial/staubli, rx160_macro.xacro (Apache-2.0), which quotes Stäubli manual D28086504A, 19/06/2012; masses from CAD. Lengths again in rs-opw-kinematics, staubli_rx160.",
    reach: "1710 mm to the flange = 150 + 825 + 625 + 110.",
    "payload, mass, repeatability": FROM_MEMORY,
  },
  assumptions: [
    ACCELERATIONS_ASSUMED,
    TCP_SPEED_ASSUMED,
    SHAPES_FITTED,
    "The published masses of the links are those of CAD solids and add up to 155 kg of the robot's 248 kg.",
  ],
  shapeError_m: 0.037,
};
