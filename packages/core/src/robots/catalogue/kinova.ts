// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const KINOVA: CatalogueMaker = {
  vendor: "Kinova",
  robots: [
    {
      id: "kinova_gen3",
      name: "Kinova Gen3",
      home_deg: [0, 15, 180, -130, 0, 55, 90],
      frames: ["base_link", "tool_frame"],
      repository: "Kinovarobotics/ros2_kortex",
      path: "kortex_description/robots/gen3.xacro dof:=7",
      table: `
joint_1 0 0 0.15643 -z -360 360 80
joint_2 0 -0.005375 0.12838 y -128.3425 128.3425 80
joint_3 0 -0.006375 0.21038 -z -360 360 80
joint_4 0 -0.006375 0.21038 y -147.2502 147.2502 80
joint_5 0 -0.006375 0.20843 -z -360 360 70
joint_6 0 -0.00017505 0.10593 y -119.7482 119.7482 70
joint_7 0 -0.00017505 0.10593 -z -360 360 70
flange 0 0 0.061525 0 0 0`,
    },
    {
      id: "kinova_gen3_lite",
      name: "Kinova Gen3 lite",
      payload: { kg: 0.5, from: "data sheet" },
      frames: ["base_link", "tool_frame"],
      repository: "Kinovarobotics/ros2_kortex",
      path: "kortex_description/robots/gen3_lite.urdf",
      table: `
joint_1 0 0 0.12825 z -154.1256 154.1256 91.6732
joint_2 0 -0.03 0.115 -y -154.1256 154.1256 91.6732
joint_3 0 0 0.28 y -154.1256 154.1256 91.6732
joint_4 0 0.02 0.14 z -148.4 148.4 91.6732
joint_5 0.0285 0 0.105 x -147.2502 147.2502 91.6732
joint_6 0.0285 0 0.105 z -148.4 148.4 183.3465
flange 0 0 0.13 0 0 90`,
    },
  ],
};
