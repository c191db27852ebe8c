// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const YASKAWA: CatalogueMaker = {
  vendor: "Yaskawa",
  robots: [
    {
      id: "yaskawa_motomini",
      name: "Yaskawa MotoMini",
      payload: { kg: 0.5, from: "data sheet" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_motomini_support/urdf/motomini.xacro",
      table: `
joint_1_s 0 0 0.103 z -170 170 315
joint_2_l 0.02 0 0 y -85 90 315
joint_3_u 0 0 0.165 -y -50 90 420
joint_4_r 0.165 0 0 -x -140 140 600
joint_5_b 0 0 0 -y -30 210 600
joint_6_t 0 0 0 z -360 360 600
flange 0 0 -0.04 180 0 0
world 0 0 0.103 0 0 0`,
    },
    {
      id: "yaskawa_gp4",
      name: "Yaskawa GP4",
      payload: { kg: 4, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_gp4_support/urdf/gp4.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.33 z -170 170 465
joint_2_l 0 0 0 y -110 130 465
joint_3_u 0 0 0.26 -y -65 200 525
joint_4_r 0.29 0 0.015 -x -200 200 565
joint_5_b 0 0 0 -y -123 123 565
joint_6_t 0 0 0 -x -455 455 1000
flange 0.072 0 0 0 -90 180
world 0 0 0.33 0 0 0`,
    },
    {
      id: "yaskawa_gp7",
      name: "Yaskawa GP7",
      payload: { kg: 7, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_gp7_support/urdf/gp7.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.33 z -170 170 375
joint_2_l 0.04 0 0 y -65 145 315
joint_3_u 0 0 0.445 -y -70 190 410
joint_4_r 0.44 0 0.04 -x -190 190 550
joint_5_b 0 0 0 -y -135 135 550
joint_6_t 0 0 0 -x -360.6426 360.6426 1001.8
flange 0.08 0 0 0 -90 180
world 0 0 0.33 0 0 0`,
    },
    {
      id: "yaskawa_gp12",
      name: "Yaskawa GP12",
      payload: { kg: 12, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_gp12_support/urdf/gp12.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.45 z -170 170 259.865
joint_2_l 0.155 0 0 y -90 155 229.9394
joint_3_u 0 0 0.614 -y -85 150 259.9796
joint_4_r 0.64 0 0.2 -x -200 200 469.8655
joint_5_b 0 0 0 -y -150 150 469.7796
joint_6_t 0 0 0 -x -455 455 699.8278
flange 0.1 0 0 0 -90 180
world 0 0 0.45 0 0 0`,
    },
    {
      id: "yaskawa_gp25",
      name: "Yaskawa GP25",
      payload: { kg: 25, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_gp25_support/urdf/gp25.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.505 z -180 180 210
joint_2_l 0.15 0 0 y -105 155 210
joint_3_u 0 0 0.76 -y -86 160 265
joint_4_r 0 0 0.2 -x -200 200 420
joint_5_b 0.795 0 0 -y -155 150 420
joint_6_t 0 0 0 -x -455 455 885
flange 0.1 0 0 0 -90 180
world 0 0 0.505 0 0 0`,
    },
    {
      id: "yaskawa_gp35l",
      name: "Yaskawa GP35L",
      payload: { kg: 35, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_gp35l_support/urdf/gp35l.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.54 z -180 180 180
joint_2_l 0.145 0 0 y -90 135 140
joint_3_u 0 0 1.15 -y -80 206 178
joint_4_r 1.225 0 0.21 -x -360 360 250
joint_5_b 0 0 0 -y -125 125 250
joint_6_t 0 0 0 -x -360 360 360
flange 0.175 0 0 0 -90 180
world 0 0 0.54 0 0 0`,
    },
    {
      id: "yaskawa_gp50",
      name: "Yaskawa GP50",
      payload: { kg: 50, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_gp50_support/urdf/gp50.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.54 z -180 180 180
joint_2_l 0.145 0 0 y -90 135 178
joint_3_u 0 0 0.87 -y -80 206 178
joint_4_r 0 0 0.21 -x -360 360 250
joint_5_b 1.025 0 0 -y -125 125 250
joint_6_t 0 0 0 -x -360 360 360
flange 0.175 0 0 0 -90 180
world 0 0 0.54 0 0 0`,
    },
    {
      id: "yaskawa_gp88",
      name: "Yaskawa GP88",
      payload: { kg: 88, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_gp88_support/urdf/gp88.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.54 z -180 180 170
joint_2_l 0.32 0 0 y -90 155 140
joint_3_u 0 0 0.87 -y -80 90 160
joint_4_r 0 0 0.21 -x -360 360 230
joint_5_b 1.025 0 0 -y -125 125 230
joint_6_t 0 0 0 -x -360 360 350
flange 0.175 0 0 0 -90 180
world 0 0 0.54 0 0 0`,
    },
    {
      id: "yaskawa_gp110",
      name: "Yaskawa GP110",
      payload: { kg: 110, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_gp110_support/urdf/gp110.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.54 z -180 180 140
joint_2_l 0.32 0 0 y -90 155 110
joint_3_u 0 0 0.87 -y -80 90 130
joint_4_r 0 0 0.235 -x -360 360 175
joint_5_b 1.02 0 0 -y -125 125 175
joint_6_t 0 0 0 -x -360 360 255
flange 0.2 0 0 0 -90 180
world 0 0 0.54 0 0 0`,
    },
    {
      id: "yaskawa_gp180",
      name: "Yaskawa GP180",
      payload: { kg: 180, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_gp180_support/urdf/gp180.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.65 z -180 180 125
joint_2_l 0.325 0 0 y -60 76 115
joint_3_u 0 0 1.15 -y -86 90 125
joint_4_r 1.225 0 0.3 -x -360 360 182
joint_5_b 0 0 0 -y -130 130 175
joint_6_t 0.225 0 0 -x -360 360 265
flange 0 0 0 0 -90 180
world 0 0 0.65 0 0 0`,
    },
    {
      id: "yaskawa_hc10",
      name: "Yaskawa HC10",
      payload: { kg: 10, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_hc10_support/urdf/hc10.xacro",
      table: `
joint_1_s 0 0 0.275 z -180 180 130
joint_2_l 0 0 0 y -180 180 130
joint_3_u 0 0 0.7 -y -5 355 180
joint_4_r 0 0 -0.5 z -180 180 180
joint_5_b 0 0.162 0 -y -180 180 250
joint_6_t 0 0 0 z -180 180 250
flange 0 0 -0.13 180 0 0
world 0 0 0.275 0 0 0`,
    },
    {
      id: "yaskawa_hc20",
      name: "Yaskawa HC20",
      payload: { kg: 20, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_hc20_support/urdf/hc20.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.38 z -180 180 80
joint_2_l 0 0 0 y -180 180 80
joint_3_u 0 0 0.82 -y -67 247 120
joint_4_r 0.88 0 0 -x -210 210 130
joint_5_b 0 0 0 -y -180 180 180
joint_6_t 0 0 0 -x -210 210 180
flange 0.2 0 0 0 -90 180
world 0 0 0.38 0 0 0`,
    },
    {
      id: "yaskawa_ar2010",
      name: "Yaskawa AR2010",
      payload: { kg: 12, from: "data sheet" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/motoman",
      path: "motoman_ar2010_support/urdf/ar2010.xacro",
      section: { kind: "yaskawa" },
      table: `
joint_1_s 0 0 0.505 z -180 180 210
joint_2_l 0.15 0 0 y -105 155 210
joint_3_u 0 0 0.76 -y -86 160 220
joint_4_r 1.082 0 0.2 -x -150 150 435
joint_5_b 0 0 0 -y -135 90 435
joint_6_t 0.1 0 0 -x -210 210 700
flange 0 0 0 0 -90 180
world 0 0 0.505 0 0 0`,
    },
  ],
};
