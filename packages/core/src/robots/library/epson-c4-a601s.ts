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

/** All joints 0 stands with the upper arm upright and the forearm level along +y of its base. */
export const epsonC4A601s: Robot = {
  id: "epson_c4_a601s",
  name: "Epson C4-A601S",
  vendor: "Epson",
  vendorSection: sectionOfData({ kind: "epson" }),
  arm: {
    name: "Epson C4-A601S",
    joints: [
      joint("joint1", [0, 0, 0.32], [0, 0, 1], inDegrees(-170, 170, 450)),
      joint("joint2", [0, 0.1, 0], [1, 0, 0], inDegrees(-160, 65, 450)),
      joint("joint3", [0, 0, 0.25], [1, 0, 0], inDegrees(-51, 225, 514)),
      joint("joint4", [0, 0, 0], [0, -1, 0], inDegrees(-200, 200, 555)),
      joint("joint5", [0, 0.25, 0], [1, 0, 0], inDegrees(-135, 135, 555)),
      joint("joint6", [0, 0.065, 0], [0, -1, 0], inDegrees(-360, 360, 720)),
    ],
    lastJointFromFlange: pose([0, 0, 0], [-0.5, -0.5, -0.5, 0.5]),
  },
  family: orthoParallel([0.1, 0, 0, 0.32, 0.25, 0.25, 0.065], [-1, 0, -1, 0, 0, -2], [1, -1, -1, -1, -1, -1]),
  frames: { base: "base_link", tip: "flange" },
  baseFromVendorWorld: pose(),
  home_rad: [0, 0, 0, 0, -Math.PI / 2, 0],
  payload_kg: 1,
  payloadMax_kg: 4,
  reach_m: 0.6,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "wrist",
  repeatability_m: 20e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 27,
  paint: { casting: "#f1f1ee", dark: "#23272b", cover: "#c9cdd1" },
  sources: {
    "lengths, limits, speeds": "4rtur1t0/ARTE, parameters of the Prosix C4-A60 (LGPL-3.0): the numbers alone.",
    "zeros and senses":
      "SPEL+ language reference, TLSet: Tool 0 of six-axis arms; axes of the C8L in a public kinematics catalogue. docs/languages/spel.md.",
    reach: "600 mm = 100 + 250 + 250.",
    "payload, mass, repeatability": FROM_MEMORY,
  },
  assumptions: [
    ACCELERATIONS_ASSUMED,
    TCP_SPEED_ASSUMED,
    SHAPES_ESTIMATED,
    "The senses of joints 4, 5 and 6 are those of one public model of a sister arm.",
    "Masses of the links are not published.",
  ],
  shapeError_m: 0.08,
};
