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
} from "./write.ts";

/** All joints 0 stands straight up; the arm reaches along +x of its base. */
export const densoVs060: Robot = {
  id: "denso_vs060",
  name: "Denso VS-060",
  vendor: "Denso",
  vendorSection: sectionOfData({ kind: "denso" }),
  arm: {
    name: "Denso VS-060",
    joints: [
      joint("joint_1", [0, 0, 0.1815], [0, 0, 1], inRadians(-2.96706, 2.96706, 3.92699081698724)),
      joint("joint_2", [0, 0, 0.1635], [0, 1, 0], inRadians(-2.094395, 2.094395, 2.61799387799149)),
      joint("joint_3", [0, 0, 0.305], [0, 1, 0], inRadians(-2.181662, 2.70526, 2.85832571599111)),
      joint("joint_4", [-0.01, 0, 0.1645], [0, 0, 1], inRadians(-4.712389, 4.712389, 3.92699081698724)),
      joint("joint_5", [0, 0, 0.1355], [0, 1, 0], inRadians(-2.094395, 2.094395, 3.02168853397778)),
      joint("joint_6", [0, 0, 0.07], [0, 0, 1], inRadians(-6.283185, 6.283185, 6.28318530717959)),
    ],
    lastJointFromFlange: pose(),
  },
  family: orthoParallel([0, -0.01, 0, 0.345, 0.305, 0.3, 0.07], [0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
  frames: { base: "base_link", tip: "J6" },
  baseFromVendorWorld: pose(),
  home_rad: [0, 0, Math.PI / 2, 0, Math.PI / 2, 0],
  payload_kg: 4,
  payloadMax_kg: 4,
  reach_m: 0.605,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "wrist",
  repeatability_m: 20e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 28,
  paint: { casting: "#eef0f2", dark: "#22272d", cover: "#2d6fb5" },
  sources: {
    "lengths, limits, speeds":
      "DENSORobot/denso_robot_ros, vs060_description/vs060.urdf, commit f6798bd (MIT), by the maker.",
    reach: "605 mm = 305 + √(300² + 10²), rounded.",
    "payload, mass, repeatability": FROM_MEMORY,
  },
  assumptions: [ACCELERATIONS_ASSUMED, TCP_SPEED_ASSUMED, SHAPES_ESTIMATED, "Masses of the links are not published."],
  shapeError_m: 0.08,
};
