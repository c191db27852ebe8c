// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const DOOSAN: CatalogueMaker = {
  vendor: "Doosan",
  robots: [
    {
      id: "doosan_a0509",
      name: "Doosan A0509",
      payload: { kg: 5, from: "designation" },
      frames: ["base_link", "link_6"],
      repository: "DoosanRobotics/doosan-robot2",
      path: "dsr_description2/urdf/a0509.urdf",
      table: `
joint_1 0 0 0.156 z -360 360 180
joint_2 0 0 0 y -360 360 180
joint_3 0 0 0.409 y -160 160 180
joint_4 0 0 0.367 z -360 360 360
joint_5 0 0 0 y -360 360 360
joint_6 0 0 0.124 z -360 360 360
flange 0 0 0 0 0 0
world 0 0 0.45 0 0 0`,
    },
    {
      id: "doosan_a0912",
      name: "Doosan A0912",
      payload: { kg: 9, from: "designation" },
      frames: ["base_link", "link_6"],
      repository: "DoosanRobotics/doosan-robot2",
      path: "dsr_description2/urdf/a0912.urdf",
      table: `
joint_1 0 0 0.195 z -360 360 180
joint_2 0 0.039 0 y -360 360 180
joint_3 0 0 0.56 y -160 160 180
joint_4 0 0 0.516 z -360 360 360
joint_5 0 0 0 y -360 360 360
joint_6 0 0 0.124 z -360 360 360
flange 0 0 0 0 0 0
world 0 0 0.45 0 0 0`,
    },
    {
      id: "doosan_e0509",
      name: "Doosan E0509",
      payload: { kg: 5, from: "designation" },
      frames: ["base_link", "link_6"],
      repository: "DoosanRobotics/doosan-robot2",
      path: "dsr_description2/urdf/e0509.urdf",
      table: `
joint_1 0 0 0.2045 z -360 360 180
joint_2 0 0 0 y -360 360 180
joint_3 0 0 0.373 y -155 155 180
joint_4 0 0 0.373 z -360 360 225
joint_5 0 0 0 y -360 360 225
joint_6 0 0 0.1725 z -360 360 225
flange 0 0 0 0 0 0
world 0 0 0.45 0 0 0`,
    },
    {
      id: "doosan_m0609",
      name: "Doosan M0609",
      payload: { kg: 6, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "DoosanRobotics/doosan-robot2",
      path: "dsr_description2/urdf/m0609.urdf",
      table: `
joint_1 0 0 0.1345 z -360 360 150
joint_2 0 0.0062 0 y -360 360 150
joint_3 0 0 0.411 y -150 150 180
joint_4 0 0 0.368 z -360 360 225
joint_5 0 0 0 y -360 360 225
joint_6 0 0 0.121 z -360 360 225
flange 0 0 0 0 -90 180
world 0 0 0.45 0 0 0`,
    },
    {
      id: "doosan_m0617",
      name: "Doosan M0617",
      payload: { kg: 6, from: "designation" },
      frames: ["base_link", "link_6"],
      repository: "DoosanRobotics/doosan-robot2",
      path: "dsr_description2/urdf/m0617.urdf",
      table: `
joint_1 0 0 0.153 z -360 360 100
joint_2 0 0.0345 0 y -360 360 100
joint_3 0 0 0.845 y -165 165 150
joint_4 0 0 0.734 z -360 360 225
joint_5 0 0 0 y -360 360 225
joint_6 0 0 0.121 z -360 360 225
flange 0 0 0 0 0 0
world 0 0 0.45 0 0 0`,
    },
    {
      id: "doosan_m1013",
      name: "Doosan M1013",
      payload: { kg: 10, from: "designation" },
      frames: ["base_link", "link_6"],
      repository: "DoosanRobotics/doosan-robot2",
      path: "dsr_description2/urdf/m1013.urdf",
      table: `
joint_1 0 0 0.1525 z -360 360 120
joint_2 0 0.0345 0 y -360 360 120
joint_3 0 0 0.62 y -160 160 180
joint_4 0 0 0.559 z -360 360 225
joint_5 0 0 0 y -360 360 225
joint_6 0 0 0.121 z -360 360 225
flange 0 0 0 0 0 0`,
    },
    {
      id: "doosan_m1509",
      name: "Doosan M1509",
      payload: { kg: 15, from: "designation" },
      frames: ["base_link", "link_6"],
      repository: "DoosanRobotics/doosan-robot2",
      path: "dsr_description2/urdf/m1509.urdf",
      table: `
joint_1 0 0 0.1525 z -360 360 150
joint_2 0 0.0345 0 y -360 360 150
joint_3 0 0 0.411 y -150 150 180
joint_4 0 0 0.368 z -360 360 225
joint_5 0 0 0 y -360 360 225
joint_6 0 0 0.121 z -360 360 225
flange 0 0 0 0 0 0
world 0 0 0.45 0 0 0`,
    },
    {
      id: "doosan_h2017",
      name: "Doosan H2017",
      payload: { kg: 20, from: "designation" },
      frames: ["base_link", "link_6"],
      repository: "DoosanRobotics/doosan-robot2",
      path: "dsr_description2/urdf/h2017.urdf",
      table: `
joint_1 0 0 0.3443 z -360 360 100
joint_2 0 0.0099 0 y -125 125 80
joint_3 0 0 0.845 y -160 160 100
joint_4 0 0 0.734 z -360 360 180
joint_5 0 0 0 y -360 360 180
joint_6 0 0 0.121 z -360 360 225
flange 0 0 0 0 0 0
world 0 0 0.45 0 0 0`,
    },
    {
      id: "doosan_h2515",
      name: "Doosan H2515",
      payload: { kg: 25, from: "designation" },
      frames: ["base_link", "link_6"],
      repository: "DoosanRobotics/doosan-robot2",
      path: "dsr_description2/urdf/h2515.urdf",
      table: `
joint_1 0 0 0.3443 z -360 360 100
joint_2 0 0.0099 0 y -125 125 80
joint_3 0 0 0.7595 y -160 160 100
joint_4 0 0 0.6195 z -360 360 180
joint_5 0 0 0 y -360 360 180
joint_6 0 0 0.121 z -360 360 225
flange 0 0 0 0 0 0
world 0 0 0.45 0 0 0`,
    },
  ],
};
