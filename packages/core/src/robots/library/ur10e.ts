import { pose } from "../../spatial/pose.ts";
import type { SerialArm } from "../../model/arm.ts";
import { familyOf } from "../family.ts";
import type { Robot } from "../../model/robot.ts";
import { LINK_PROFILES } from "./forms/ur10e.ts";
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
  solid,
  turned,
} from "./write.ts";

/** The angles of the data file, rounded as it rounds them, so that its poses are met to the last digit. */
const QUARTER = 1.570796327;

const arm: SerialArm = {
  name: "Universal Robots UR10e",
  joints: [
    joint("shoulder_pan_joint", turned([0, 0, 0.1807], [0, 0, Math.PI]), [0, 0, 1], inDegrees(-360, 360, 120, 330)),
    joint("shoulder_lift_joint", turned([0, 0, 0], [QUARTER, 0, 0]), [0, 0, 1], inDegrees(-360, 360, 120, 330)),
    joint("elbow_joint", [-0.6127, 0, 0], [0, 0, 1], inDegrees(-180, 180, 180, 150)),
    joint("wrist_1_joint", [-0.57155, 0, 0.17415], [0, 0, 1], inDegrees(-360, 360, 180, 54)),
    joint(
      "wrist_2_joint",
      turned([0, -0.11985, -2.458164590756244e-11], [QUARTER, 0, 0]),
      [0, 0, 1],
      inDegrees(-360, 360, 180, 54),
    ),
    joint(
      "wrist_3_joint",
      turned([0, 0.11655, -2.390480459346185e-11], [1.570796326589793, Math.PI, Math.PI]),
      [0, 0, 1],
      inDegrees(-360, 360, 180, 54),
    ),
  ],
  lastJointFromFlange: pose(),
};

/** The controller's base is the root link turned by 180° about z. */
export const ur10e: Robot = {
  id: "ur10e",
  name: "Universal Robots UR10e",
  vendor: "Universal Robots",
  vendorSection: sectionOfData({ kind: "universal-robots", model: "UR10" }),
  arm,
  family: familyOf(arm),
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: turned([0, 0, 0], [0, 0, Math.PI]),
  home_rad: [0, -Math.PI / 2, Math.PI / 2, -Math.PI / 2, -Math.PI / 2, 0],
  payload_kg: 10,
  payloadMax_kg: 10,
  reach_m: 1.3,
  reachMeasuredFrom: "axis-2",
  reachMeasuredTo: "wrist",
  workspace: { reach_m: 1.3, wristInFlange_m: [0, 0, -0.11655] },
  repeatability_m: 50e-6,
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  mass_kg: 33.5,
  masses: [
    solid(7.369, [0.021, -0.027, 0], [0.03408, 0.03529, 0.02156, 2e-5, -0.00425, 8e-5], [Math.PI / 2, 0, 0]),
    solid(13.051, [-0.2327, 0, 0.158], [0.02814, 0.77068, 0.76943, 5e-5, -0.01561, 2e-5]),
    solid(3.989, [-0.33155, 0, 0.068], [0.01014, 0.30928, 0.30646, 8e-5, 0.00916, 0]),
    solid(2.1, [0, -0.018, 0.007], [0.00296, 0.00222, 0.00258, -1e-5, 0, -0.00024], [Math.PI / 2, 0, 0]),
    solid(1.98, [0, 0.018, -0.007], [0.00296, 0.00222, 0.00258, -1e-5, 0, -0.00024], [-Math.PI / 2, 0, 0]),
    solid(0.615, [0, 0, -0.026], [0.0004, 0.00041, 0.00034, 0, 0, 0]),
  ],
  form: linkProfiles(LINK_PROFILES, ["casting", "casting", "casting", "casting", "casting", "casting", "metal"]),
  paint: { casting: "#c9ced2", dark: "#33393d", cover: "#5d8fb8" },
  sources: {
    lengths: "UniversalRobots/Universal_Robots_ROS2_Description (BSD-3-Clause), config/ur10e/default_kinematics.yaml.",
    "limits, speeds, torques":
      "The same, config/ur10e/joint_limits.yaml: UR10e User Manual 5.8 and UR's article on joint torques.",
    "masses, inertias": "The same, config/ur10e/physical_parameters.yaml.",
    "payload, reach, mass": "10 kg, 1300 mm, 33.5 kg, as published with the pick-and-place system of the X rows.",
    repeatability: FROM_MEMORY,
  },
  assumptions: [
    ACCELERATIONS_ASSUMED,
    TCP_SPEED_ASSUMED,
    SHAPES_FITTED,
    "The elbow is kept within ±180°, as the vendor's own robot file does; the controller allows ±360°.",
    "Each UR10e is calibrated in the factory; these are the lengths of the drawing.",
    "Reach is counted from axis 2 to the wrist centre, where axes 5 and 6 meet; the links would reach 1304 mm.",
  ],
  shapeError_m: 0.021,
};
