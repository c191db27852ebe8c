// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const STAUBLI: CatalogueMaker = {
  vendor: "Stäubli",
  robots: [
    {
      id: "staubli_tx2_60",
      name: "Stäubli TX2-60",
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/staubli_experimental",
      path: "staubli_tx2_60_support/urdf/tx2_60.xacro",
      section: { kind: "staubli-val3" },
      table: `
joint_1 0 0 0.375 z -180 180 435
joint_2 0 0 0 y -127.5 127.5 385
joint_3 0 0.02 0.29 y -152.5 152.5 500
joint_4 0 0 0 z -270 270 995
joint_5 0 0 0.31 y -121 132.5 1065
joint_6 0 0 0.07 z -270 270 1445
flange 0 0 0 0 0 0
world 0 0 0.375 0 0 0`,
    },
    {
      id: "staubli_tx2_60l",
      name: "Stäubli TX2-60L",
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/staubli_experimental",
      path: "staubli_tx2_60_support/urdf/tx2_60l.xacro",
      section: { kind: "staubli-val3" },
      table: `
joint_1 0 0 0.375 z -180 180 435
joint_2 0 0 0 y -127.5 127.5 385
joint_3 0 0.02 0.4 y -152.5 152.5 500
joint_4 0 0 0 z -270 270 995
joint_5 0 0 0.45 y -121 132.5 1065
joint_6 0 0 0.07 z -270 270 1445
flange 0 0 0 0 0 0
world 0 0 0.375 0 0 0`,
    },
    {
      id: "staubli_tx2_90",
      name: "Stäubli TX2-90",
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/staubli_experimental",
      path: "staubli_tx2_90_support/urdf/tx2_90.xacro",
      section: { kind: "staubli-val3" },
      table: `
joint_1 0 0 0.478 z -180 180 265
joint_2 0.05 0 0 y -130 147.5 210
joint_3 0 0.05 0.425 y -145 145 315
joint_4 0 0 0 z -270 270 450
joint_5 0 0 0.425 y -115 140 370
joint_6 0 0 0.1 z -270 270 630
flange 0 0 0 0 0 0
world 0 0 0.478 0 0 0`,
    },
    {
      id: "staubli_tx2_90l",
      name: "Stäubli TX2-90L",
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/staubli_experimental",
      path: "staubli_tx2_90_support/urdf/tx2_90l.xacro",
      section: { kind: "staubli-val3" },
      table: `
joint_1 0 0 0.478 z -180 180 225
joint_2 0.05 0 0 y -130 147.5 180
joint_3 0 0.05 0.5 y -145 145 270
joint_4 0 0 0 z -270 270 450
joint_5 0 0 0.55 y -115 140 370
joint_6 0 0 0.1 z -270 270 630
flange 0 0 0 0 0 0
world 0 0 0.478 0 0 0`,
    },
    {
      id: "staubli_tx2_90xl",
      name: "Stäubli TX2-90XL",
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/staubli_experimental",
      path: "staubli_tx2_90_support/urdf/tx2_90xl.xacro",
      section: { kind: "staubli-val3" },
      table: `
joint_1 0 0 0.478 z -180 180 200
joint_2 0.05 0 0 y -130 147.5 170
joint_3 0 0.05 0.65 y -145 145 240
joint_4 0 0 0 z -270 270 420
joint_5 0 0 0.65 y -115 140 360
joint_6 0 0 0.1 z -270 270 630
flange 0 0 0 0 0 0
world 0 0 0.478 0 0 0`,
    },
  ],
};
