// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const TECHMAN: CatalogueMaker = {
  vendor: "Techman",
  robots: [
    {
      id: "techman_tm5_700",
      name: "Techman TM5-700",
      payload: { kg: 6, from: "data sheet" },
      frames: ["base", "flange"],
      repository: "TechmanRobotInc/tmr_ros2",
      path: "tm_description/urdf/tm5-700-nominal.urdf",
      table: `
joint_1 0 0 0.1452 z -270 270 180
joint_2 0 0 0 y -180 180 180
joint_3 0 0 0.329 y -155 155 180
joint_4 0 -0.1223 0.3115 y -180 180 225
joint_5 0 0 0.106 z -180 180 225
joint_6 0 -0.11315 0 -y -270 270 225
flange 0 0 0 90 0 0`,
    },
    {
      id: "techman_tm5_900",
      name: "Techman TM5-900",
      payload: { kg: 4, from: "data sheet" },
      frames: ["base", "flange"],
      repository: "TechmanRobotInc/tmr_ros2",
      path: "tm_description/urdf/tm5-900-nominal.urdf",
      table: `
joint_1 0 0 0.1452 z -270 270 180
joint_2 0 0 0 y -180 180 180
joint_3 0 0 0.429 y -155 155 180
joint_4 0 -0.1223 0.4115 y -180 180 225
joint_5 0 0 0.106 z -180 180 225
joint_6 0 -0.11315 0 -y -270 270 225
flange 0 0 0 90 0 0`,
    },
    {
      id: "techman_tm12",
      name: "Techman TM12",
      payload: { kg: 12, from: "designation" },
      frames: ["base", "flange"],
      repository: "TechmanRobotInc/tmr_ros2",
      path: "tm_description/urdf/tm12-nominal.urdf",
      table: `
joint_1 0 0 0.1652 z -270 270 120
joint_2 0 0 0 y -180 180 120
joint_3 0 0 0.6361 y -166 166 180
joint_4 0 -0.1563 0.5579 y -180 180 180
joint_5 0 0 0.106 z -180 180 180
joint_6 0 -0.11315 0 -y -270 270 180
flange 0 0 0 90 0 0`,
    },
    {
      id: "techman_tm14",
      name: "Techman TM14",
      payload: { kg: 14, from: "designation" },
      frames: ["base", "flange"],
      repository: "TechmanRobotInc/tmr_ros2",
      path: "tm_description/urdf/tm14-nominal.urdf",
      table: `
joint_1 0 0 0.1652 z -270 270 120
joint_2 0 0 0 y -180 180 120
joint_3 0 0 0.5361 y -163 163 180
joint_4 0 -0.1563 0.4579 y -180 180 150
joint_5 0 0 0.106 z -180 180 150
joint_6 0 -0.11315 0 -y -270 270 180
flange 0 0 0 90 0 0`,
    },
  ],
};
