import { pose } from "../../spatial/pose.ts";
import type { Robot } from "../../model/robot.ts";
import { LINK_PROFILES } from "./forms/kuka_kr6r900sixx.ts";
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

/** A1, A4 and A6 turn by the left hand, as KUKA counts them. */
export const kukaKr6R900: Robot = {
  id: "kuka_kr6r900sixx",
  name: "KUKA KR 6 R900 sixx",
  vendor: "KUKA",
  vendorSection: sectionOfData({ kind: "kuka", model: "#KR6R900SIXX C2 FLR ZH100" }),
  arm: {
    name: "KUKA KR 6 R900 sixx",
    joints: [
      joint("joint_a1", [0, 0, 0.4], [0, 0, -1], inDegrees(-170, 170, 360)),
      joint("joint_a2", [0.025, 0, 0], [0, 1, 0], inDegrees(-190, 45, 300)),
      joint("joint_a3", [0.455, 0, 0], [0, 1, 0], inDegrees(-120, 156, 360)),
      joint("joint_a4", [0, 0, 0.035], [-1, 0, 0], inDegrees(-185, 185, 381)),
      joint("joint_a5", [0.42, 0, 0], [0, 1, 0], inDegrees(-120, 120, 388)),
      joint("joint_a6", [0.08, 0, 0], [-1, 0, 0], inDegrees(-350, 350, 615)),
    ],
    lastJointFromFlange: turned([0, 0, 0], [0, Math.PI / 2, 0]),
  },
  family: orthoParallel([0.025, -0.035, 0, 0.4, 0.455, 0.42, 0.08], [0, -1, 0, 0, 0, 0], [-1, 1, 1, -1, 1, -1]),
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: pose(),
  home_rad: [0, -Math.PI / 2, Math.PI / 2, 0, Math.PI / 2, 0],
  payload_kg: 6,
  payloadMax_kg: 6,
  reach_m: 0.9015,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "wrist",
  repeatability_m: 30e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 52,
  form: linkProfiles(LINK_PROFILES, ["cover", "casting", "casting", "casting", "casting", "casting", "metal"]),
  paint: { casting: "#f0701a", dark: "#2a2d2f", cover: "#8d8478" },
  sources: {
    "lengths, limits, speeds":
      "ros-industrial/kuka_experimental, kr6r900sixx_macro.xacro (Apache-2.0), which quotes KUKA Spez KR AGILUS sixx V12, 26.03.2015.",
    reach: "901.5 mm = 25 + 455 + √(420² + 35²).",
    payload: "The name of the model: 6 kg.",
    "mass, repeatability": FROM_MEMORY,
  },
  assumptions: [ACCELERATIONS_ASSUMED, TCP_SPEED_ASSUMED, SHAPES_FITTED],
  shapeError_m: 0.02,
};
