// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const KAWASAKI: CatalogueMaker = {
  vendor: "Kawasaki",
  robots: [
    {
      id: "kawasaki_rs007n",
      name: "Kawasaki RS007N",
      payload: { kg: 7, from: "designation" },
      frames: ["base_link", "link6"],
      repository: "Kawasaki-Robotics/khi_robot",
      path: "khi_rs_description/urdf/rs007n.urdf.xacro",
      section: { kind: "kawasaki" },
      table: `
joint1 0 0 0.36 -z -180 180 470
joint2 0 0 0 -x -135 135 380
joint3 0 0 0.355 x -155 155 520
joint4 0 0 0.0925 z -200 200 550
joint5 0 0 0.2825 x -125 125 550
joint6 0 0 0.078 z -360 360 1000
flange 0 0 0 0 0 0`,
    },
    {
      id: "kawasaki_rs013n",
      name: "Kawasaki RS013N",
      payload: { kg: 13, from: "designation" },
      frames: ["base_link", "link6"],
      repository: "Kawasaki-Robotics/khi_robot",
      path: "khi_rs_description/urdf/rs013n.urdf.xacro",
      section: { kind: "kawasaki" },
      table: `
joint1 0 0 0.505 -z -180 180 265
joint2 0 0 0 -x -105 138 250
joint3 0 0 0.7 x -159 135 265
joint4 0 0 0.11 z -200 200 475
joint5 0 0 0.65 x -125 125 475
joint6 0 0 0.078 z -360 360 730
flange 0 0 0 0 0 0`,
    },
    {
      id: "kawasaki_rs020n",
      name: "Kawasaki RS020N",
      payload: { kg: 20, from: "designation" },
      frames: ["base_link", "link6"],
      repository: "Kawasaki-Robotics/khi_robot",
      path: "khi_rs_description/urdf/rs020n.urdf.xacro",
      section: { kind: "kawasaki" },
      table: `
joint1 0 0 0.465 -z -180 180 190
joint2 0 0.15 0 -x -105 155 205
joint3 0 0 0.77 x -163 150 210
joint4 0 0 0.161 z -270 270 400
joint5 0 0 0.644 x -145 145 360
joint6 0 0 0.095 z -360 360 610
flange 0 0 0 0 0 0`,
    },
    {
      id: "kawasaki_rs025n",
      name: "Kawasaki RS025N",
      payload: { kg: 25, from: "designation" },
      frames: ["base_link", "link6"],
      repository: "Kawasaki-Robotics/khi_robot",
      path: "khi_rs_description/urdf/rs025n.urdf.xacro",
      section: { kind: "kawasaki" },
      table: `
joint1 0 0 0.58 -z -180 180 215
joint2 0 0 0 -x -100 131 215
joint3 0 0 0.885 x -161 145 270
joint4 0 0 0.15 z -270 270 420
joint5 0 0 0.85 x -145 145 420
joint6 0 0 0.1 z -360 360 780
flange 0 0 0 0 0 0`,
    },
    {
      id: "kawasaki_rs080n",
      name: "Kawasaki RS080N",
      payload: { kg: 80, from: "designation" },
      frames: ["base_link", "link6"],
      repository: "Kawasaki-Robotics/khi_robot",
      path: "khi_rs_description/urdf/rs080n.urdf.xacro",
      section: { kind: "kawasaki" },
      table: `
joint1 0 0 0.68 -z -180 180 180
joint2 0 0.15 0 -x -105 140 180
joint3 0 0 0.87 x -155 135 160
joint4 0 0 0.267 z -360 360 185
joint5 0 0 0.813 x -145 145 165
joint6 0 0 0.165 z -360 360 280
flange 0 0 0 0 0 0`,
    },
  ],
};
