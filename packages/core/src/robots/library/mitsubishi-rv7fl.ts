import { pose } from "../../spatial/pose.ts";
import type { Robot } from "../../model/robot.ts";
import { sectionOfData } from "../vendor-sections.ts";
import {
  ACCELERATIONS_ASSUMED,
  FROM_MEMORY,
  SHAPES_ESTIMATED,
  TCP_SPEED_ASSUMED,
  TCP_SPEED_MPS,
  inDegrees,
  joint,
  orthoParallel,
} from "./write.ts";

/** All joints 0 stands straight up; the arm reaches along +x of its base. */
export const mitsubishiRv7fl: Robot = {
  id: "mitsubishi_rv7fl",
  name: "Mitsubishi RV-7FL",
  vendor: "Mitsubishi Electric",
  vendorSection: sectionOfData({ kind: "mitsubishi" }),
  arm: {
    name: "Mitsubishi RV-7FL",
    joints: [
      joint("joint1", [0, 0, 0.4], [0, 0, 1], inDegrees(-240, 240, 288)),
      joint("joint2", [0, 0, 0], [0, 1, 0], inDegrees(-110, 130, 321)),
      joint("joint3", [0, 0, 0.435], [0, 1, 0], inDegrees(0, 162, 360)),
      joint("joint4", [-0.05, 0, 0.47], [0, 0, 1], inDegrees(-200, 200, 337)),
      joint("joint5", [0, 0, 0], [0, 1, 0], inDegrees(-120, 120, 450)),
      joint("joint6", [0, 0, 0.085], [0, 0, 1], inDegrees(-360, 360, 720)),
    ],
    lastJointFromFlange: pose(),
  },
  family: orthoParallel([0, -0.05, 0, 0.4, 0.435, 0.47, 0.085], [0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
  frames: { base: "link0", tip: "link6" },
  baseFromVendorWorld: pose(),
  home_rad: [0, 0, Math.PI / 2, 0, Math.PI / 2, 0],
  payload_kg: 7,
  payloadMax_kg: 7,
  reach_m: 0.908,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "wrist",
  repeatability_m: 20e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 67,
  paint: { casting: "#f3f2ee", dark: "#25292c", cover: "#c6cacd" },
  sources: {
    "lengths, limits, speeds":
      "tork-a/melfa_robot, melfa_description/urdf/rv7fl.xacro, commit 8437e45 (Apache-2.0); a public kinematics catalogue has the same lengths for the RV-7FRL.",
    reach: "908 mm = 435 + √(470² + 50²), rounded.",
    "payload, mass, repeatability": FROM_MEMORY,
  },
  assumptions: [ACCELERATIONS_ASSUMED, TCP_SPEED_ASSUMED, SHAPES_ESTIMATED, "Masses of the links are not published."],
  shapeError_m: 0.08,
};
