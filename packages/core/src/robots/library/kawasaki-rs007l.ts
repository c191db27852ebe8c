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
  turned,
} from "./write.ts";

const QUARTER = Math.PI / 2;

/** All joints 0 stands straight up; the arm reaches along +y of its base. */
export const kawasakiRs007l: Robot = {
  id: "kawasaki_rs007l",
  name: "Kawasaki RS007L",
  vendor: "Kawasaki",
  vendorSection: sectionOfData({ kind: "kawasaki" }),
  arm: {
    name: "Kawasaki RS007L",
    joints: [
      joint("joint1", [0, 0, 0.36], [0, 0, -1], inDegrees(-180, 180, 370)),
      joint("joint2", turned([0, 0, 0], [0, -QUARTER, 0]), [0, 0, 1], inDegrees(-135, 135, 310)),
      joint("joint3", [0.455, 0, 0], [0, 0, -1], inDegrees(-157, 157, 410)),
      joint("joint4", turned([0.0925, 0, 0], [0, QUARTER, 0]), [0, 0, 1], inDegrees(-200, 200, 550)),
      joint("joint5", turned([0, 0, 0.3825], [0, -QUARTER, 0]), [0, 0, -1], inDegrees(-125, 125, 550)),
      joint("joint6", turned([0.078, 0, 0], [0, QUARTER, 0]), [0, 0, 1], inDegrees(-360, 360, 1000)),
    ],
    lastJointFromFlange: pose(),
  },
  family: orthoParallel([0, 0, 0, 0.36, 0.455, 0.475, 0.078], [-1, 0, 0, 0, 0, 1], [-1, 1, -1, 1, -1, 1]),
  frames: { base: "base_link", tip: "link6" },
  baseFromVendorWorld: pose(),
  home_rad: [0, 0, -QUARTER, 0, -QUARTER, 0],
  payload_kg: 7,
  payloadMax_kg: 7,
  reach_m: 0.93,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "wrist",
  repeatability_m: 30e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 37,
  masses: [
    { mass_kg: 8.188 },
    { mass_kg: 6.826 },
    { mass_kg: 5.236 },
    { mass_kg: 5.066 },
    { mass_kg: 1.625 },
    { mass_kg: 0.625 },
  ],
  paint: { casting: "#f2f2ee", dark: "#22262a", cover: "#c8cdd0" },
  sources: {
    "lengths, limits, speeds, masses":
      "Kawasaki-Robotics/khi_robot, rs007l_macro.xacro, commit 57200db (BSD-3-Clause), by the maker.",
    reach: "930 mm = 455 + 92.5 + 382.5.",
    "payload, mass, repeatability": FROM_MEMORY,
  },
  assumptions: [
    ACCELERATIONS_ASSUMED,
    TCP_SPEED_ASSUMED,
    SHAPES_ESTIMATED,
    "Centres of mass and inertias of the links are not published.",
  ],
  shapeError_m: 0.08,
};
