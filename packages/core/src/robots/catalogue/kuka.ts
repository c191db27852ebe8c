// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const KUKA: CatalogueMaker = {
  vendor: "KUKA",
  robots: [
    {
      id: "kuka_kr4_r600",
      name: "KUKA KR 4 R600",
      payload: { kg: 4, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_agilus_support/urdf/kr4_r600.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.1494 -z -170 170 336
joint_2 0 0.0636 0.1806 y -195 40 336
joint_3 0.29 -0.0046 0 y -115 150 487.5
joint_4 0.1694 -0.059 0.02 -x -185 185 600
joint_5 0.1406 0.045 0 y -120 120 529.1
joint_6 0.0465 -0.045 0 -x -350 350 800
flange 0.0285 0 0 0 90 0`,
    },
    {
      id: "kuka_kr6_r700_2",
      name: "KUKA KR 6 R700-2",
      payload: { kg: 6, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_agilus_support/urdf/kr6_r700_2.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.208 -z -170 170 360
joint_2 0.025 0.0907 0.192 y -190 45 300
joint_3 0.335 -0.0042 0 y -120 156 360
joint_4 0.141 -0.0865 0.025 -x -185 185 450
joint_5 0.224 0.0505 0 y -120 120 450
joint_6 0.0615 -0.0505 0 -x -350 350 540
flange 0.0285 0 0 0 90 0`,
    },
    {
      id: "kuka_kr10_r900_2",
      name: "KUKA KR 10 R900-2",
      payload: { kg: 10, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_agilus_support/urdf/kr10_r900_2.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.208 -z -170 170 300
joint_2 0.025 0.0907 0.192 y -190 45 225
joint_3 0.455 -0.0042 0 y -120 156 330
joint_4 0.196 -0.0865 0.025 -x -185 185 360
joint_5 0.224 0.0505 0 y -120 120 360
joint_6 0.0615 -0.0505 0 -x -350 350 433
flange 0.0285 0 0 0 90 0`,
    },
    {
      id: "kuka_kr10_r1100_2",
      name: "KUKA KR 10 R1100-2",
      payload: { kg: 10, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_agilus_support/urdf/kr10_r1100_2.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.208 -z -170 170 300
joint_2 0.025 0.0907 0.192 y -190 45 225
joint_3 0.56 -0.0042 0 y -120 156 330
joint_4 0.196 -0.0865 0.025 -x -185 185 360
joint_5 0.319 0.0505 0 y -120 120 360
joint_6 0.0615 -0.0505 0 -x -350 350 433
flange 0.0285 0 0 0 90 0`,
    },
    {
      id: "kuka_kr16_r1610_2",
      name: "KUKA KR 16 R1610-2",
      payload: { kg: 16, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_cybertech_support/urdf/kr16_r1610_2.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.3127 -z -185 185 200
joint_2 0.16 0 0.2073 y -185 65 175
joint_3 0.78 0 0 y -138 175 190
joint_4 0.427 0 0.15 -x -350 350 430
joint_5 0.228 0 0 y -130 130 430
joint_6 0.153 0 0 -x -350 350 630
flange 0 0 0 0 90 0`,
    },
    {
      id: "kuka_kr16_r2010_2",
      name: "KUKA KR 16 R2010-2",
      payload: { kg: 16, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_cybertech_support/urdf/kr16_r2010_2.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0 -z -185 185 200
joint_2 0.16 0 0.52 y -185 65 175
joint_3 0.98 0 0 y -138 175 190
joint_4 0 0 0.15 -x -350 350 430
joint_5 0.86 0 0 y -130 130 430
joint_6 0 0 0 -x -350 350 630
flange 0.153 0 0 0 90 0`,
    },
    {
      id: "kuka_kr20_r1810_2",
      name: "KUKA KR 20 R1810-2",
      payload: { kg: 20, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_cybertech_support/urdf/kr20_r1810_2.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.3127 -z -185 185 200
joint_2 0.16 0 0.2073 y -185 65 171.6
joint_3 0.78 0 0 y -138 175 190
joint_4 0.427 0 0.15 -x -350 350 430
joint_5 0.433 0 0 y -130 130 430
joint_6 0.153 0 0 -x -350 350 630
flange 0 0 0 0 90 0`,
    },
    {
      id: "kuka_kr50_r2100",
      name: "KUKA KR 50 R2100",
      payload: { kg: 50, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_iontec_support/urdf/kr50_r2100.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.236 -z -185 185 180
joint_2 0.175 -0.054 0.339 y -175 60 175
joint_3 0.89 -0.0975 0 y -120 165 175
joint_4 0.30805 0.1515 0.05 -x -180 180 250
joint_5 0.72695 0.04795 0 y -125 125 250
joint_6 0.149 -0.04795 0 -x -350 350 360
flange 0.036 0 0 0 90 0`,
    },
    {
      id: "kuka_kr70_r2100",
      name: "KUKA KR 70 R2100",
      payload: { kg: 70, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_iontec_support/urdf/kr70_r2100.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.236 -z -185 185 180
joint_2 0.175 -0.054 0.339 y -175 60 157.9757
joint_3 0.89 -0.0975 0 y -120 165 160
joint_4 0.30805 0.1515 0.05 -x -180 180 230
joint_5 0.72695 0.04795 0 y -125 125 230
joint_6 0.149 -0.04795 0 -x -350 350 320
flange 0.036 0 0 0 90 0`,
    },
    {
      id: "kuka_kr120_r2700_2",
      name: "KUKA KR 120 R2700-2",
      payload: { kg: 120, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_quantec_support/urdf/kr120_r2700_2.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.3056 -z -185 185 116.8
joint_2 0.33 -0.072 0.3394 y -140 -5 111.4518
joint_3 1.15 -0.103 0 y -120 168 119.3643
joint_4 0.828 0.175 0.115 -x -350 350 190
joint_5 0.392 0.096 0 y -125 125 180
joint_6 0.1665 -0.096 0 -x -350 350 260
flange 0.0485 0 0 0 90 0`,
    },
    {
      id: "kuka_kr210_r2700_2",
      name: "KUKA KR 210 R2700-2",
      payload: { kg: 210, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_quantec_support/urdf/kr210_r2700_2.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0 -z -185 185 116.8
joint_2 0.33 0 0.645 y -140 -5 111.446
joint_3 1.15 0 0 y -120 168 112
joint_4 0 0 0.115 -x -350 350 179
joint_5 1.22 0 0 y -125 125 172
joint_6 0 0 0 -x -350 350 220
flange 0.215 0 0 0 90 0`,
    },
    {
      id: "kuka_kr210_r3100_2",
      name: "KUKA KR 210 R3100-2",
      payload: { kg: 210, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_quantec_support/urdf/kr210_r3100_2.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0 -z -185 185 105
joint_2 0.33 0 0.645 y -140 -5 94
joint_3 1.35 0 0 y -120 168 100
joint_4 0 0 0.115 -x -350 350 136
joint_5 1.42 0 0 y -122.5 122.5 129
joint_6 0 0 0 -x -350 350 206
flange 0.24 0 0 0 90 0`,
    },
    {
      id: "kuka_kr240_r3330",
      name: "KUKA KR 240 R3330",
      payload: { kg: 240, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_fortec_support/urdf/kr240_r3330.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.4 -z -185 185 100
joint_2 0.5 0 0.645 y -130 20 90.0289
joint_3 1.3 0 0 y -100 144 90
joint_4 1.064 0 -0.055 -x -350 350 120
joint_5 0.461 0 0 y -120 120 119.9659
joint_6 0.29 0 0 -x -350 350 159.5344
flange 0 0 0 0 90 0`,
    },
    {
      id: "kuka_kr500_r2800_2",
      name: "KUKA KR 500 R2800-2",
      payload: { kg: 500, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_fortec_support/urdf/kr500_r2800_2.urdf.xacro",
      section: { kind: "kuka" },
      table: `
joint_1 0 0 0.3646 -z -185 185 100
joint_2 0.5 -0.0755 0.4354 y -130 5 79.5447
joint_3 1.25 -0.1173 0 y -110 162 90
joint_4 0.7217 0.1928 0.15 -x -350 350 90
joint_5 0.3178 0.1193 0 y -120 120 100
joint_6 0.2052 -0.1193 0 -x -350 350 163
flange 0.0808 0 0 0 90 0`,
    },
    {
      id: "kuka_lbr_iisy3_r760",
      name: "KUKA LBR iisy 3 R760",
      payload: { kg: 3, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_lbr_iisy_support/urdf/lbr_iisy3_r760.urdf.xacro",
      table: `
joint_1 0 0 0.1264 -z -185 185 200
joint_2 0 0 0.0886 y -230 50 200
joint_3 0.3 0 0 y -150 150 200
joint_4 0 0 0 -x -175 175 300
joint_5 0.3 0 0 y -110 110 300
joint_6 0 0 0 -x -220 220 400
flange 0.1605 0 0 0 90 0`,
    },
    {
      id: "kuka_lbr_iisy11_r1300",
      name: "KUKA LBR iisy 11 R1300",
      payload: { kg: 11, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_lbr_iisy_support/urdf/lbr_iisy11_r1300.urdf.xacro",
      table: `
joint_1 0 0 0.1845 -z -185 185 200
joint_2 0 -0.1011 0.1155 y -230 50 200
joint_3 0.59 0.0237 0 y -150 150 200
joint_4 0.1139 0.0774 0 -x -180 180 230
joint_5 0.4181 0.0507 0 y -110 110 260
joint_6 0.0837 -0.0507 0 -x -220 220 430
flange 0.0943 0 0 0 90 0`,
    },
    {
      id: "kuka_lbr_iisy15_r930",
      name: "KUKA LBR iisy 15 R930",
      payload: { kg: 15, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "kroshu/kuka_robot_descriptions",
      path: "kuka_lbr_iisy_support/urdf/lbr_iisy15_r930.urdf.xacro",
      table: `
joint_1 0 0 0 -z -185 185 200
joint_2 0 0 0.3 y -230 50 200
joint_3 0.385 0 0 y -150 150 200
joint_4 0 0 0 -x -180 180 230
joint_5 0.367 0 0 y -110 110 260
joint_6 0 0 0 -x -220 220 430
flange 0.178 0 0 0 90 0`,
    },
  ],
};
