import { pose } from "../../spatial/pose.ts";
import type { Robot } from "../../model/robot.ts";
import { sectionOfData } from "../vendor-sections.ts";
import {
  ACCELERATIONS_ASSUMED,
  FROM_MEMORY,
  SHAPES_ESTIMATED,
  TCP_SPEED_ASSUMED,
  TCP_SPEED_MPS,
  inRadians,
  joint,
  orthoParallel,
  turned,
} from "./write.ts";

/** A1, A4 and A6 turn by the left hand, as KUKA counts them. */
export const kukaKr6p2: Robot = {
  id: "kuka_kr6_2",
  name: "KUKA KR 6/2",
  vendor: "KUKA",
  vendorSection: sectionOfData({ kind: "kuka", model: "#KR6_2 H C4 FLR ZH02" }),
  arm: {
    name: "KUKA KR 6/2",
    joints: [
      joint("joint_a1", [0, 0, 0.675], [0, 0, -1], inRadians(-3.228859116, 3.228859116, 2.722713633)),
      joint("joint_a2", [0.26, 0, 0], [0, 1, 0], inRadians(-2.705260341, 0.6108652382, 2.722713633)),
      joint("joint_a3", [0.68, 0, 0], [0, 1, 0], inRadians(-2.268928028, 2.687807048, 2.722713633)),
      joint("joint_a4", [0.67, 0, -0.035], [-1, 0, 0], inRadians(-6.108652382, 6.108652382, 5.986479334)),
      joint("joint_a5", [0, 0, 0], [0, 1, 0], inRadians(-2.268928028, 2.268928028, 6.318091892)),
      joint("joint_a6", [0, 0, 0], [-1, 0, 0], inRadians(-6.108652382, 6.108652382, 11.50171977)),
    ],
    lastJointFromFlange: turned([0.115, 0, 0], [0, Math.PI / 2, 0]),
  },
  family: orthoParallel([0.26, 0.035, 0, 0.675, 0.68, 0.67, 0.115], [0, -1, 0, 0, 0, 0], [-1, 1, 1, -1, 1, -1]),
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: pose(),
  home_rad: [0, -Math.PI / 2, Math.PI / 2, 0, Math.PI / 2, 0],
  payload_kg: 6,
  payloadMax_kg: 6,
  reach_m: 1.611,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "wrist",
  repeatability_m: 100e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 235,
  paint: { casting: "#f0701a", dark: "#2a2d2f", cover: "#3b3e40" },
  sources: {
    "lengths, limits, speeds":
      "Numbers of ARTE, KR6_2 parameters; lengths and limits again in robotkinematicscatalogue 1.1.2, KUKA_KR6_2; the arm again in kuka_experimental, kr16_2_macro.xacro. They reproduce the published formulas of the KRC6 teaching system (row M-42).",
    reach: "1611 mm; 260 + 680 + √(670² + 35²) = 1610.9 mm.",
    payload: "The name of the model: 6 kg.",
    "mass, repeatability": FROM_MEMORY,
  },
  assumptions: [ACCELERATIONS_ASSUMED, TCP_SPEED_ASSUMED, SHAPES_ESTIMATED],
  shapeError_m: 0.1,
};
