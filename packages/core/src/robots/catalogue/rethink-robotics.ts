// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const RETHINK_ROBOTICS: CatalogueMaker = {
  vendor: "Rethink Robotics",
  robots: [
    {
      id: "rethink_sawyer",
      name: "Rethink Sawyer",
      payload: { kg: 4, from: "data sheet" },
      home_deg: [0, -67.5, 0, 125, 0, 32.5, 0],
      frames: ["base", "right_hand"],
      repository: "RethinkRobotics/sawyer_robot",
      path: "sawyer_description/urdf/sawyer_base.urdf.xacro",
      table: `
right_j0 0 0 0.08 z -174.7693 174.7693 99.7
right_j1 0.081 0.05 0.237 y -218.2683 130.2677 76.1
right_j2 0.14 0.1425 0 x -174.3281 174.3281 112.1278
right_j3 0.26 -0.042 0 y -174.4 174.4 112.1278
right_j4 0.125 -0.1265 0 x -170.5 170.5 199.6758
right_j5 0.275 0.031 0 y -170.5 170.5 199.6758
right_j6 0.11 0.1053 0 x -270 270 260.4
flange 0.0245 0 0 -90 -9.9998323984 -90`,
    },
  ],
};
