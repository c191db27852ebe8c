import { pose } from "../../spatial/pose.ts";
import type { Robot } from "../../model/robot.ts";
import { LINK_PROFILES } from "./forms/abb_irb120.ts";
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
  solid,
  turned,
} from "./write.ts";

export const abbIrb120: Robot = {
  id: "abb_irb120",
  name: "ABB IRB 120-3/0.6",
  vendor: "ABB",
  vendorSection: sectionOfData({ kind: "abb" }),
  arm: {
    name: "ABB IRB 120-3/0.6",
    joints: [
      joint("joint_1", [0, 0, 0], [0, 0, 1], inRadians(-2.87979, 2.87979, 4.36332)),
      joint("joint_2", [0, 0, 0.29], [0, 1, 0], inRadians(-1.91986, 1.91986, 4.36332)),
      joint("joint_3", [0, 0, 0.27], [0, 1, 0], inRadians(-1.91986, 1.22173, 4.36332)),
      joint("joint_4", [0, 0, 0.07], [1, 0, 0], inRadians(-2.79253, 2.79253, 5.58505)),
      joint("joint_5", [0.302, 0, 0], [0, 1, 0], inRadians(-2.094395, 2.094395, 5.58505)),
      joint("joint_6", [0.072, 0, 0], [1, 0, 0], inRadians(-6.98132, 6.98132, 7.33038)),
    ],
    lastJointFromFlange: turned([0, 0, 0], [0, Math.PI / 2, 0]),
  },
  family: orthoParallel([0, -0.07, 0, 0.29, 0.27, 0.302, 0.072], [0, 0, -1, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: pose(),
  home_rad: [0, 0, 0, 0, Math.PI / 2, 0],
  payload_kg: 3,
  payloadMax_kg: 3,
  reach_m: 0.58,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "wrist",
  repeatability_m: 10e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 25,
  masses: [
    solid(3.067, [9.77e-5, -0.00012, 0.23841], [0.0142175, 0.0144041, 0.0104533, -1.28579e-5, -2.31364e-5, 1.93404e-5]),
    solid(3.909, [0.00078, -0.00212, 0.10124], [0.0603111, 0.041569, 0.0259548, 9.83431e-6, 5.72407e-5, -0.00050497]),
    solid(2.944, [0.02281, 0.00106, 0.05791], [0.00835606, 0.016713, 0.0126984, -8.01545e-5, 0.00142884, -0.000182227]),
    solid(1.328, [0.2247, 0.00015, 0.00041], [0.00284661, 0.00401346, 0.0052535, -2.12765e-5, -1.6435e-5, 1.31336e-5]),
    solid(
      0.546,
      [-0.00109, 3.68e-5, 6.22e-5],
      [0.000404891, 0.000892825, 0.000815468, 1.61943e-6, 8.46805e-7, -1.51792e-8],
    ),
    solid(0.137, [-0.00706, -0.00017, -1.32e-6], [0.001, 0.001, 0.001, 0, 0, 0]),
  ],
  form: linkProfiles(LINK_PROFILES, ["casting", "casting", "casting", "casting", "casting", "casting", "metal"]),
  paint: { casting: "#d9612a", dark: "#2b2f31", cover: "#40474a" },
  sources: {
    "lengths, limits, speeds, masses":
      "ros-industrial/abb_experimental, irb120_3_58_macro.xacro (Apache-2.0), which quotes ABB ROB0149EN_D, May 2012; masses from the vendor's CAD.",
    reach: "580 mm = 270 + √(302² + 70²).",
    payload: "The name of the model: 3 kg.",
    "mass, repeatability": FROM_MEMORY,
  },
  assumptions: [
    ACCELERATIONS_ASSUMED,
    TCP_SPEED_ASSUMED,
    SHAPES_FITTED,
    "The inertia of link 6 in the source is a round number, not a measured one.",
  ],
  shapeError_m: 0.014,
};
