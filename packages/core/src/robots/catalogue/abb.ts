// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const ABB: CatalogueMaker = {
  vendor: "ABB",
  robots: [
    {
      id: "abb_irb1200_5_90",
      name: "ABB IRB 1200-5/0.9",
      payload: { kg: 5, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb1200_support/urdf/irb1200_5_90.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0.3991 z -170 170 288.0259
joint_2 0 0 0 y -100 130 240
joint_3 0 0 0.448 y -200 70 300
joint_4 0 0 0.042 x -269.9777 269.9777 400
joint_5 0.451 0 0 y -130 130 405.0239
joint_6 0.082 0 0 x -360 360 600
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb1200_7_70",
      name: "ABB IRB 1200-7/0.7",
      payload: { kg: 7, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb1200_support/urdf/irb1200_7_70.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0.3991 z -170 170 288.0259
joint_2 0 0 0 y -100 135 240
joint_3 0 0 0.35 y -200 70 300
joint_4 0 0 0.042 x -269.9777 269.9777 400
joint_5 0.351 0 0 y -130 130 405.0239
joint_6 0.082 0 0 x -360 360 600
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb1600_6_12",
      name: "ABB IRB 1600-6/1.2",
      payload: { kg: 6, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb1600_support/urdf/irb1600_6_12.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0 z -180 180 150
joint_2 0.15 0 0.4865 y -63 110 160
joint_3 0 0 0.475 y -235 55 170
joint_4 0.3 0 0 x -200 200 320
joint_5 0.3 0 0 y -115 115 400
joint_6 0.065 0 0 x -400 400 450
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb1600_8_145",
      name: "ABB IRB 1600-8/1.45",
      payload: { kg: 8, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb1600_support/urdf/irb1600_8_145.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0 z -180 180 180
joint_2 0.15 0 0.4865 y -90 120 180
joint_3 0 0 0.7 y -245 65 200
joint_4 0.3 0 0 x -200 200 400
joint_5 0.3 0 0 y -115 115 400
joint_6 0.065 0 0 x -400 400 460
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb2400_12_155",
      name: "ABB IRB 2400-12/1.55",
      payload: { kg: 12, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb",
      path: "abb_irb2400_support/urdf/irb2400_12_155.xacro",
      section: {
        kind: "abb",
        couplings: [{ axis: 3, with: 2, factor: 1 }],
        sources: {
          couplings:
            "ros-industrial/abb, J23_coupled = true of the IRB 2400: its parallel rod keeps the forearm, so axis 3 shows joint 3 and joint 2.",
        },
      },
      table: `
joint_1 0 0 0 z -180 180 150
joint_2 0.1 0 0.615 y -100 110 150
joint_3 0 0 0.705 y -60 65 150
joint_4 0 0 0.135 x -199.9623 199.9623 360
joint_5 0.755 0 0 y -120 120 360
joint_6 0 0 0 x -400 400 450
flange 0.085 0 0 0 90 0`,
    },
    {
      id: "abb_irb2600_12_165",
      name: "ABB IRB 2600-12/1.65",
      payload: { kg: 12, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb2600_support/urdf/irb2600_12_165.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0.445 z -180 180 175
joint_2 0.15 0 0 y -155 95 175
joint_3 0 0 0.7 y -155 75 175
joint_4 0 0 0.115 x -400 400 360
joint_5 0.795 0 0 y -119.9774 119.9774 360
joint_6 0.085 0 0 x -400 400 500.0203
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb4600_20_250",
      name: "ABB IRB 4600-20/2.50",
      payload: { kg: 20, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb4600_support/urdf/irb4600_20_250.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0.495 z -180 180 175
joint_2 0.175 0 0 y -90 150 175
joint_3 0 0 1.095 y -180 75 175
joint_4 0 0 0.175 x -400 400 360
joint_5 1.2305 0 0 y -125 120 360
joint_6 0.085 0 0 x -400 400 500
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb4600_40_255",
      name: "ABB IRB 4600-40/2.55",
      payload: { kg: 40, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb4600_support/urdf/irb4600_40_255.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0.495 z -180 180 175
joint_2 0.175 0 0 y -90 150 175
joint_3 0 0 1.095 y -180 75 175
joint_4 0 0 0.175 x -400 400 250
joint_5 1.27 0 0 y -125 120 250
joint_6 0.135 0 0 x -400 400 360
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb4600_60_205",
      name: "ABB IRB 4600-60/2.05",
      payload: { kg: 60, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb4600_support/urdf/irb4600_60_205.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0.495 z -179.966 179.966 175
joint_2 0.175 0 0 y -89.9544 149.9431 175
joint_3 0 0 0.9 y -179.966 74.9429 175
joint_4 0 0 0.175 x -400 400 250
joint_5 0.96 0 0 y -124.9621 119.9774 250
joint_6 0.135 0 0 x -400 400 360
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb6640_185_280",
      name: "ABB IRB 6640-185/2.8",
      payload: { kg: 185, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb",
      path: "abb_irb6640_support/urdf/irb6640_185_280.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0.78 z -170 170 100
joint_2 0.32 0 0 y -64.9734 85.1 90
joint_3 0 0 1.075 y -180.0233 70 90
joint_4 0 0 0.2 x -300 300 170
joint_5 1.392 0 0 y -119.9774 119.9774 140
joint_6 0.2 0 0 x -360 360 190
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb6700_200_260",
      name: "ABB IRB 6700-200/2.60",
      payload: { kg: 200, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb6700_support/urdf/irb6700_200_260.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0.78 z -170 170 110
joint_2 0.32 0 0 y -65 85 110
joint_3 0 0 1.125 y -180 70 110
joint_4 0 0 0.2 x -300 300 190
joint_5 1.1425 0 0 y -130 130 150
joint_6 0.2 0 0 x -360 360 210
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb6700_235_265",
      name: "ABB IRB 6700-235/2.65",
      payload: { kg: 235, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb6700_support/urdf/irb6700_235_265.xacro",
      section: { kind: "abb" },
      table: `
joint_1 0 0 0.78 z -170 170 100
joint_2 0.32 0 0 y -65 85 90
joint_3 0 0 1.135 y -180 70 90
joint_4 0 0 0.2 x -300 300 170
joint_5 1.1825 0 0 y -130 130 120
joint_6 0.2 0 0 x -360 360 190
flange 0 0 0 0 90 0`,
    },
    {
      id: "abb_irb7600_150_350",
      name: "ABB IRB 7600-150/3.5",
      payload: { kg: 150, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "ros-industrial/abb_experimental",
      path: "abb_irb7600_support/urdf/irb7600_150_350.xacro",
      table: `
joint_1 0 0 0 z -180 180 100
joint_2 0.41 0 0.78 y -60 85 60
joint_3 0 0 1.075 y -180 60 60
joint_4 0 0 0.165 x -300 300 100
joint_5 2.012 0 0 y -100 100 100
joint_6 0.25 0 0 x -360 360 190
flange 0 0 0 0 90 0`,
    },
  ],
};
