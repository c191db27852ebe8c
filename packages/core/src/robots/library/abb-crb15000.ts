import { pose } from "../../spatial/pose.ts";
import type { SerialArm } from "../../model/arm.ts";
import { familyOf } from "../family.ts";
import type { Robot } from "../../model/robot.ts";
import { LINK_PROFILES } from "./forms/abb_crb15000_5_95.ts";
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
  turned,
} from "./write.ts";

const arm: SerialArm = {
  name: "ABB GoFa CRB 15000-5/0.95",
  joints: [
    joint("joint_1", [0, 0, 0.265], [0, 0, 1], inDegrees(-180, 180, 125)),
    joint("joint_2", [0, 0, 0], [0, 1, 0], inDegrees(-180, 180, 125)),
    joint("joint_3", [0, 0, 0.444], [0, 1, 0], inDegrees(-225, 85, 140)),
    joint("joint_4", [0, 0, 0.11], [1, 0, 0], inDegrees(-180, 180, 200)),
    joint("joint_5", [0.47, 0, 0], [0, 1, 0], inDegrees(-180, 180, 200)),
    joint("joint_6", [0.101, 0, 0.08], [1, 0, 0], inDegrees(-180, 180, 200)),
  ],
  lastJointFromFlange: turned([0, 0, 0], [0, Math.PI / 2, 0]),
};

/** No spherical wrist: axis 6 passes axis 5 at 80 mm. */
export const abbCrb15000: Robot = {
  id: "abb_crb15000_5_95",
  name: "ABB GoFa CRB 15000-5/0.95",
  vendor: "ABB",
  vendorSection: sectionOfData({ kind: "abb" }),
  arm,
  family: familyOf(arm),
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: pose(),
  home_rad: [0, 0, 0, 0, Math.PI / 2, 0],
  payload_kg: 5,
  payloadMax_kg: 5,
  reach_m: 0.95,
  reachMeasuredFrom: "axis-2",
  reachMeasuredTo: "wrist",
  repeatability_m: 50e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 27,
  form: linkProfiles(LINK_PROFILES, ["cover", "casting", "casting", "casting", "casting", "casting", "metal"]),
  paint: { casting: "#e9ebea", dark: "#4a5054", cover: "#7b8286" },
  sources: {
    "lengths, limits, speeds": "ros-industrial/abb_experimental, crb15000_5_95 (Apache-2.0).",
    "payload, reach, mass, repeatability": FROM_MEMORY,
  },
  assumptions: [
    ACCELERATIONS_ASSUMED,
    TCP_SPEED_ASSUMED,
    SHAPES_FITTED,
    "To which point the vendor measures the reach of 950 mm is not published; the arm itself is the limit.",
  ],
  shapeError_m: 0.013,
};
