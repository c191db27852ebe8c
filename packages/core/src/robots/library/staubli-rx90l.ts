import { sectionOfData } from "../vendor-sections.ts";
import { pose } from "../../spatial/pose.ts";
import type { Robot } from "../../model/robot.ts";
import { ACCELERATIONS_ASSUMED, SHAPES_ESTIMATED, inDegrees, joint } from "./write.ts";

/** Joint zero is V+'s own: home 0, −90, +90, 0, 0, 0 stands straight up. */
export const staubliRx90l: Robot = {
  id: "staubli_rx90l",
  name: "Stäubli RX90L",
  vendor: "Stäubli",
  vendorSection: sectionOfData({ kind: "staubli-v-plus" }),
  arm: {
    name: "Stäubli RX90L",
    joints: [
      joint("joint_1", [0, 0, 0.42], [0, 0, 1], inDegrees(-160, 160, 236)),
      joint("joint_2", [0, 0, 0], [0, 1, 0], inDegrees(-227.5, 47.5, 200)),
      joint("joint_3", [0.45, 0, 0], [0, 1, 0], inDegrees(-52.5, 232.5, 286)),
      joint("joint_4", [0, 0, 0], [0, 0, 1], inDegrees(-270, 270, 401)),
      joint("joint_5", [0, 0, 0.65], [0, 1, 0], inDegrees(-105, 120, 320)),
      joint("joint_6", [0, 0, 0], [0, 0, 1], inDegrees(-270, 270, 580)),
    ],
    lastJointFromFlange: pose([0, 0, 0.085]),
  },
  family: {
    kind: "ortho-parallel",
    a1_m: 0,
    a2_m: 0,
    b_m: 0,
    c1_m: 0.42,
    c2_m: 0.45,
    c3_m: 0.65,
    c4_m: 0.085,
    offsets_rad: [0, -Math.PI / 2, Math.PI / 2, 0, 0, 0],
    signs: [1, 1, 1, 1, 1, 1],
    formulaFromFlange: pose(),
  },
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: pose([0, 0, 0.42]),
  home_rad: [0, -Math.PI / 2, Math.PI / 2, 0, 0, 0],
  payload_kg: 3.5,
  payloadMax_kg: 6,
  reach_m: 1.185,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "flange",
  repeatability_m: 25e-6,
  maxTcpSpeed_mps: 12.6,
  sources: {
    "a3 = 450 mm, d4 = 650 mm":
      "The vertical 80.003 mm move hidden in two published #PPOINT lines (IJMMS 10(3) 2017) fits only these lengths.",
    "shoulder height 420 mm, flange 85 mm":
      "robotkinematicscatalogue 1.1.2, Staubli_RX90BL; overall height 1185 mm in IJMMS 10(3) 2017.",
    "joint limits, payload, repeatability, TCP speed": "IJMMS 10(3) 2017, Table 1 and Section 3.",
    "joint speeds": "RX90 values 236, 200, 286, 401, 320, 580 °/s; the RX90L is assumed to have the same.",
  },
  assumptions: [ACCELERATIONS_ASSUMED, SHAPES_ESTIMATED],
  shapeError_m: 0.02,
};
