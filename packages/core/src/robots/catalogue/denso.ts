// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const DENSO: CatalogueMaker = {
  vendor: "Denso",
  robots: [
    {
      id: "denso_cobotta",
      name: "DENSO COBOTTA",
      payload: { kg: 0.5, from: "data sheet" },
      frames: ["base_link", "J6"],
      repository: "DENSORobot/denso_robot_ros2",
      path: "denso_robot_descriptions/urdf/denso_robot.urdf.xacro model:=cobotta",
      table: `
joint_1 0 0 0 z -150 150 93.1
joint_2 0 0 0.18 y -60 100 43.5
joint_3 0 0 0.165 y 18 140 95.2
joint_4 -0.012 0.02 -0.345 z -170 170 146.3
joint_5 0 -0.02 0.5225 y -95 135 152.95
joint_6 0 -0.0445 0.042 z -170 170 219.45
flange 0 0 0 0 0 0`,
    },
  ],
};
