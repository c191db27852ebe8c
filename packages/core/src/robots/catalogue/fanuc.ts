// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const FANUC: CatalogueMaker = {
  vendor: "FANUC",
  robots: [
    {
      id: "fanuc_crx5ia",
      name: "FANUC CRX-5iA",
      payload: { kg: 5, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_crx_description/robot/crx5ia.urdf.xacro",
      table: `
J1 0 0 0.185 z -200 200 150
J2 0 0 0 y -179.9 179.9 150
J3 0 0 0.41 -y -68 248 180
J4 0 0 0 -x -190 190 225
J5 0.43 0 0 -y -179.9 179.9 225
J6 0 -0.13 0 -x -225 225 225
flange 0.145 0 0 0 -90 180
world 0 0 0.185 0 0 0`,
    },
    {
      id: "fanuc_crx10ia",
      name: "FANUC CRX-10iA",
      payload: { kg: 10, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_crx_description/robot/crx10ia.urdf.xacro",
      table: `
J1 0 0 0.245 z -190 190 120
J2 0 0 0 y -179.9 179.9 120
J3 0 0 0.54 -y -71 251 180
J4 0 0 0 -x -190 190 180
J5 0.54 0 0 -y -179.9 179.9 180
J6 0 -0.15 0 -x -225 225 180
flange 0.16 0 0 0 -90 180
world 0 0 0.245 0 0 0`,
    },
    {
      id: "fanuc_crx10ia_l",
      name: "FANUC CRX-10iA/L",
      payload: { kg: 10, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_crx_description/robot/crx10ia_l.urdf.xacro",
      table: `
J1 0 0 0.245 z -179.9 179.9 120
J2 0 0 0 y -179.9 179.9 120
J3 0 0 0.71 -y -270 270 180
J4 0 0 0 -x -190 190 180
J5 0.54 0 0 -y -179.9 179.9 180
J6 0 -0.15 0 -x -225 225 180
flange 0.16 0 0 0 -90 180
world 0 0 0.245 0 0 0`,
    },
    {
      id: "fanuc_crx20ia_l",
      name: "FANUC CRX-20iA/L",
      payload: { kg: 20, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_crx_description/robot/crx20ia_l.urdf.xacro",
      table: `
J1 0 0 0.245 z -179.9 179.9 80
J2 0 0 0 y -179.9 179.9 80
J3 0 0 0.71 -y -270 270 120
J4 0 0 0 -x -190 190 112.5
J5 0.54 0 0 -y -179.9 179.9 90
J6 0 -0.15 0 -x -225 225 112.5
flange 0.16 0 0 0 -90 180
world 0 0 0.245 0 0 0`,
    },
    {
      id: "fanuc_crx30ia",
      name: "FANUC CRX-30iA",
      payload: { kg: 30, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_crx_description/robot/crx30ia.urdf.xacro",
      table: `
J1 0 0 0.37 z -179.9 179.9 80
J2 0 0 0 y -179.9 179.9 80
J3 0 0 0.95 -y -270 270 120
J4 0 0 0 -x -190 190 180
J5 0.75 0 0 -y -179.9 179.9 180
J6 0 -0.185 0 -x -225 225 180
flange 0.18 0 0 0 -90 180
world 0 0 0.37 0 0 0`,
    },
    {
      id: "fanuc_lrmate200id4s",
      name: "FANUC LR Mate 200iD/4S",
      payload: { kg: 4, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_lrmate_description/robot/lrmate200id4s.urdf.xacro",
      section: { kind: "fanuc" },
      table: `
J1 0 0 0.33 z -170 170 460
J2 0 0 0 y -110 120 460
J3 0 0 0.26 -y -69 205 520
J4 0 0 0.02 -x -190 190 560
J5 0.29 0 0 -y -120 120 560
J6 0 0 0 -x -360 360 900
flange 0.07 0 0 0 -90 180
world 0 0 0.33 0 0 0`,
    },
    {
      id: "fanuc_lrmate200id7l",
      name: "FANUC LR Mate 200iD/7L",
      payload: { kg: 7, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_lrmate_description/robot/lrmate200id7l.urdf.xacro",
      section: { kind: "fanuc" },
      table: `
J1 0 0 0.33 z -180 180 370
J2 0.05 0 0 y -100 145 310
J3 0 0 0.44 -y -70 213 410
J4 0 0 0.035 -x -190 190 550
J5 0.42 0 0 -y -125 125 545
J6 0 0 0 -x -360 360 1000
flange 0.08 0 0 0 -90 180
world 0 0 0.33 0 0 0`,
    },
    {
      id: "fanuc_m10_12_14d",
      name: "FANUC M-10iD/12",
      payload: { kg: 12, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_m10_description/robot/m10_12_14d.urdf.xacro",
      section: { kind: "fanuc" },
      table: `
J1 0 0 0.45 z -185 185 260
J2 0.075 0 0 y -90 145 240
J3 0 0 0.64 -y -90 222 260
J4 0 0 0.195 -x -190 190 430
J5 0.7 0 0 -y -180 180 450
J6 0 0 0 -x -450 450 720
flange 0.075 0 0 0 -90 180
world 0 0 0.45 0 0 0`,
    },
    {
      id: "fanuc_m20_25_18d",
      name: "FANUC M-20iD/25",
      payload: { kg: 25, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_m20_description/robot/m20_25_18d.urdf.xacro",
      section: { kind: "fanuc" },
      table: `
J1 0 0 0.425 z -185 185 210
J2 0.075 0 0 y -100 160 210
J3 0 0 0.84 -y -90 220 265
J4 0 0 0.215 -x -200 200 420
J5 0.89 0 0 -y -180 180 420
J6 0 0 0 -x -450 450 720
flange 0.09 0 0 0 -90 180
world 0 0 0.425 0 0 0`,
    },
    {
      id: "fanuc_m20_35_18d",
      name: "FANUC M-20iD/35",
      payload: { kg: 35, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_m20_description/robot/m20_35_18d.urdf.xacro",
      section: { kind: "fanuc" },
      table: `
J1 0 0 0.425 z -185 185 180
J2 0.075 0 0 y -100 160 180
J3 0 0 0.84 -y -90 220 200
J4 0 0 0.215 -x -200 200 350
J5 0.89 0 0 -y -180 180 350
J6 0 0 0 -x -450 450 400
flange 0.09 0 0 0 -90 180
world 0 0 0.425 0 0 0`,
    },
    {
      id: "fanuc_m710ic_50",
      name: "FANUC M-710iC/50",
      payload: { kg: 50, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_m710_description/robot/m710ic_50.urdf.xacro",
      section: { kind: "fanuc" },
      table: `
J1 0 0 0.565 z -180 180 175
J2 0.15 0 0 y -90 135 175
J3 0 0 0.87 -y -80.5 205 175
J4 0 0 0.17 -x -360 360 250
J5 1.016 0 0 -y -125 125 250
J6 0 0 0 -x -360 360 355
flange 0.175 0 0 0 -90 180
world 0 0 0.565 0 0 0`,
    },
    {
      id: "fanuc_m710ic_70",
      name: "FANUC M-710iC/70",
      payload: { kg: 70, from: "designation" },
      frames: ["base_link", "fanuc_flange"],
      repository: "FANUC-CORPORATION/fanuc_description",
      path: "fanuc_m710_description/robot/m710ic_70.urdf.xacro",
      section: { kind: "fanuc" },
      table: `
J1 0 0 0.565 z -180 180 160
J2 0.15 0 0 y -90 135 120
J3 0 0 0.87 -y -80.5 205 120
J4 0 0 0.17 -x -360 360 225
J5 1.016 0 0 -y -125 125 225
J6 0 0 0 -x -360 360 225
flange 0.175 0 0 0 -90 180
world 0 0 0.565 0 0 0`,
    },
  ],
};
