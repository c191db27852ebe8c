// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const DOBOT: CatalogueMaker = {
  vendor: "Dobot",
  robots: [
    {
      id: "dobot_cr3",
      name: "Dobot CR3",
      payload: { kg: 3, from: "designation" },
      frames: ["base_link", "Link6"],
      repository: "Dobot-Arm/DOBOT_6Axis_ROS2_V4",
      path: "dobot_rviz/urdf/cr3_robot.urdf",
      table: `
joint1 0 0 0.1348 z -359.8 359.8 180
joint2 0 0 0 -y -359.8 359.8 180
joint3 0 0 0.274 -y -154.9221 154.9221 180
joint4 0 -0.1283 0.23 -y -359.8 359.8 180
joint5 0 0 0.116 z -359.8 359.8 180
joint6 0 -0.105 0 -y -359.8 359.8 180
flange 0 0 0 -90 0 180`,
    },
    {
      id: "dobot_cr5",
      name: "Dobot CR5",
      payload: { kg: 5, from: "designation" },
      frames: ["base_link", "Link6"],
      repository: "Dobot-Arm/DOBOT_6Axis_ROS2_V4",
      path: "dobot_rviz/urdf/cr5_robot.urdf",
      table: `
joint1 0 0 0.147 z -359.8 359.8 180
joint2 0 0 0 -y -359.8 359.8 180
joint3 -0.00034866 0 0.427 -y -159.9698 159.9698 180
joint4 0.00034866 -0.141 0.357 -y -359.8 359.8 180
joint5 0 0 0.116 z -359.8 359.8 180
joint6 0 -0.105 0 -y -359.8 359.8 180
flange 0 0 0 -90 0 180`,
    },
    {
      id: "dobot_cr10",
      name: "Dobot CR10",
      payload: { kg: 10, from: "designation" },
      frames: ["base_link", "Link6"],
      repository: "Dobot-Arm/DOBOT_6Axis_ROS2_V4",
      path: "dobot_rviz/urdf/cr10_robot.urdf",
      table: `
joint1 0 0 0.1765 z -359.2445 359.2445 180
joint2 0 0 0 -y -359.2445 359.2445 180
joint3 0 0 0.607 -y -163.9232 163.9232 180
joint4 0 -0.191 0.568 -y -359.2445 359.2445 180
joint5 0 0 0.125 z -359.2445 359.2445 180
joint6 0 -0.1084 0 -y -359.2445 359.2445 180
flange 0 0 0 -90 0 180`,
    },
    {
      id: "dobot_cr16",
      name: "Dobot CR16",
      payload: { kg: 16, from: "designation" },
      frames: ["base_link", "Link6"],
      repository: "Dobot-Arm/DOBOT_6Axis_ROS2_V4",
      path: "dobot_rviz/urdf/cr16_robot.urdf",
      table: `
joint1 0 0 0.1765 z -359.2445 359.2445 180
joint2 0 0 0 -y -359.2445 359.2445 180
joint3 0 0 0.512 -y -163.8659 163.8659 180
joint4 0 -0.191 0.363 -y -359.2445 359.2445 180
joint5 0 0 0.125 z -359.2445 359.2445 180
joint6 0 -0.1084 0 -y -359.2445 359.2445 180
flange 0 0 0 -90 0 180`,
    },
    {
      id: "dobot_cr20",
      name: "Dobot CR20",
      payload: { kg: 20, from: "designation" },
      frames: ["base_link", "Link6"],
      repository: "Dobot-Arm/DOBOT_6Axis_ROS2_V4",
      path: "dobot_rviz/urdf/cr20_robot.urdf",
      table: `
joint1 0 0 0.23 z -359.8 359.8 180
joint2 0 0 0 -y -359.8 359.8 180
joint3 0 -0.0468 0.8252 -y -166.1578 166.1578 180
joint4 0 -0.1288 0.746 -y -359.8 359.8 180
joint5 0 0 0.1288 z -359.8 359.8 180
joint6 0 -0.1365 0 -y -359.8 359.8 180
flange 0 0 0 -90 0 180`,
    },
    {
      id: "dobot_nova2",
      name: "Dobot Nova2",
      payload: { kg: 2, from: "designation" },
      frames: ["base_link", "Link6"],
      repository: "Dobot-Arm/DOBOT_6Axis_ROS2_V4",
      path: "dobot_rviz/urdf/nova2_robot.urdf",
      table: `
joint1 0 0 0.2234 z -359.8 359.8 180
joint2 0 0 0 -y -179.9 179.9 180
joint3 0 0 0.28 -y -159.8552 159.8552 180
joint4 0 -0.1175 0.22501 -y -359.8 359.8 180
joint5 0 0 0.12 z -359.8 359.8 180
joint6 0 -0.088004 0 -y -359.8 359.8 180
flange 0 0 0 -90 0 180`,
    },
    {
      id: "dobot_nova5",
      name: "Dobot Nova5",
      payload: { kg: 5, from: "designation" },
      frames: ["base_link", "Link6"],
      repository: "Dobot-Arm/DOBOT_6Axis_ROS2_V4",
      path: "dobot_rviz/urdf/nova5_robot.urdf",
      table: `
joint1 0 0 0.24 z -359.8 359.8 180
joint2 0 0 0 -y -179.9 179.9 180
joint3 1.9511e-7 0 0.4 -y -159.8552 159.8552 180
joint4 1.6098e-7 -0.13499953286 0.33 -y -359.8 359.8 180
joint5 0 0 0.12 z -359.8 359.8 180
joint6 0 -0.088328 0 -y -359.8 359.8 180
flange 0 0 0 -90 -2.2e-9 180`,
    },
  ],
};
