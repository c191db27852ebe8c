// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const AUBO: CatalogueMaker = {
  vendor: "AUBO",
  robots: [
    {
      id: "aubo_i3",
      name: "AUBO i3",
      payload: { kg: 3, from: "designation" },
      frames: ["base_link", "wrist3_Link"],
      repository: "AuboRobot/aubo_robot",
      path: "aubo_description/urdf/aubo_i3.urdf",
      table: `
shoulder_joint 0 0 0.157 z -174.1792 174.1792 180
upperArm_joint 0 -0.119 0 -y -174.1792 174.1792 180
foreArm_joint 0 0 0.266 y -174.1792 174.1792 180
wrist1_joint 0 0 0.2565 y -174.1792 174.1792 180
wrist2_joint 0 0 0.1025 z -174.1792 174.1792 180
wrist3_joint 0 -0.094 0 y -174.1792 174.1792 180
flange 0 0 0 90 0 0`,
    },
    {
      id: "aubo_i5",
      name: "AUBO i5",
      payload: { kg: 5, from: "designation" },
      frames: ["base_link", "wrist3_Link"],
      repository: "AuboRobot/aubo_robot",
      path: "aubo_description/urdf/aubo_i5.urdf",
      table: `
shoulder_joint 0 0 0.122 z -174.1792 174.1792 180
upperArm_joint 0 -0.1215 0 -y -174.1792 174.1792 180
foreArm_joint 0 0 0.408 y -174.1792 174.1792 180
wrist1_joint 0 0 0.376 -y -174.1792 174.1792 180
wrist2_joint 0 0 0.1025 z -174.1792 174.1792 180
wrist3_joint 0 -0.094 0 -y -174.1792 174.1792 180
flange 0 0 0 90 0 0`,
    },
    {
      id: "aubo_i10",
      name: "AUBO i10",
      payload: { kg: 10, from: "designation" },
      frames: ["base_link", "wrist3_Link"],
      repository: "AuboRobot/aubo_robot",
      path: "aubo_description/urdf/aubo_i10.urdf",
      table: `
shoulder_joint 0 0 0.1632 z -174.1792 174.1792 180
upperArm_joint 0 -0.2013 0 -y -174.1792 174.1792 180
foreArm_joint 0 0 0.647 y -174.1792 174.1792 180
wrist1_joint 0 0 0.6005 -y -174.1792 174.1792 180
wrist2_joint 0 0 0.1025 z -174.1792 174.1792 180
wrist3_joint 0 -0.094 0 -y -174.1792 174.1792 180
flange 0 0 0 90 0 0`,
    },
    {
      id: "aubo_i16",
      name: "AUBO i16",
      payload: { kg: 16, from: "designation" },
      frames: ["base_link", "wrist3_Link"],
      repository: "AuboRobot/aubo_robot",
      path: "aubo_description/urdf/aubo_i16.urdf",
      table: `
shoulder_joint 0 0 0.163 z -174.1792 174.1792 180
upperArm_joint 0 -0.191 0 -y -174.1792 174.1792 180
foreArm_joint 0 0 0.48008 y -174.1792 174.1792 180
wrist1_joint 0 0 0.36992 -y -174.1792 174.1792 180
wrist2_joint 0 0 0.1175 z -174.1792 174.1792 180
wrist3_joint 0 -0.1035 0 -y -174.1792 174.1792 180
flange 0 0 0 90 0 0`,
    },
  ],
};
