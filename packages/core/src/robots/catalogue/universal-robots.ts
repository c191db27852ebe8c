// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const UNIVERSAL_ROBOTS: CatalogueMaker = {
  vendor: "Universal Robots",
  robots: [
    {
      id: "ur3",
      name: "Universal Robots UR3",
      payload: { kg: 3, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "UniversalRobots/Universal_Robots_ROS2_Description",
      path: "urdf/ur.urdf.xacro ur_type:=ur3 name:=ur",
      section: { kind: "universal-robots", model: "UR3" },
      table: `
shoulder_pan_joint 0 0 0.1519 z -360 360 180
shoulder_lift_joint 0 0 0 y -360 360 180
elbow_joint 0.24365 0 0 y -180 180 180
wrist_1_joint 0.21325 0.11235 0 y -360 360 360
wrist_2_joint 0 0 -0.08535 -z -360 360 360
wrist_3_joint 0 0.0819 0 y -360 360 360
flange 0 0 0 90 0 180
world 0 0 0 0 0 180`,
    },
    {
      id: "ur3e",
      name: "Universal Robots UR3e",
      payload: { kg: 3, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "UniversalRobots/Universal_Robots_ROS2_Description",
      path: "urdf/ur.urdf.xacro ur_type:=ur3e name:=ur",
      section: { kind: "universal-robots", model: "UR3" },
      table: `
shoulder_pan_joint 0 0 0.15185 z -360 360 180
shoulder_lift_joint 0 0 0 y -360 360 180
elbow_joint 0.24355 0 0 y -180 180 180
wrist_1_joint 0.2132 0.13105 0 y -360 360 360
wrist_2_joint 0 0 -0.08535 -z -360 360 360
wrist_3_joint 0 0.0921 0 y -360 360 360
flange 0 0 0 90 0 180
world 0 0 0 0 0 180`,
    },
    {
      id: "ur5",
      name: "Universal Robots UR5",
      payload: { kg: 5, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "UniversalRobots/Universal_Robots_ROS2_Description",
      path: "urdf/ur.urdf.xacro ur_type:=ur5 name:=ur",
      section: { kind: "universal-robots", model: "UR5" },
      table: `
shoulder_pan_joint 0 0 0.089159 z -360 360 180
shoulder_lift_joint 0 0 0 y -360 360 180
elbow_joint 0.425 0 0 y -180 180 180
wrist_1_joint 0.39225 0.10915 0 y -360 360 180
wrist_2_joint 0 0 -0.09465 -z -360 360 180
wrist_3_joint 0 0.0823 0 y -360 360 180
flange 0 0 0 90 0 180
world 0 0 0 0 0 180`,
    },
    {
      id: "ur5e",
      name: "Universal Robots UR5e",
      payload: { kg: 5, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "UniversalRobots/Universal_Robots_ROS2_Description",
      path: "urdf/ur.urdf.xacro ur_type:=ur5e name:=ur",
      section: { kind: "universal-robots", model: "UR5" },
      table: `
shoulder_pan_joint 0 0 0.1625 z -360 360 180
shoulder_lift_joint 0 0 0 y -360 360 180
elbow_joint 0.425 0 0 y -180 180 180
wrist_1_joint 0.3922 0.1333 0 y -360 360 180
wrist_2_joint 0 0 -0.0997 -z -360 360 180
wrist_3_joint 0 0.0996 0 y -360 360 180
flange 0 0 0 90 0 180
world 0 0 0 0 0 180`,
    },
    {
      id: "ur10",
      name: "Universal Robots UR10",
      payload: { kg: 10, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "UniversalRobots/Universal_Robots_ROS2_Description",
      path: "urdf/ur.urdf.xacro ur_type:=ur10 name:=ur",
      section: { kind: "universal-robots", model: "UR10" },
      table: `
shoulder_pan_joint 0 0 0.1273 z -360 360 120
shoulder_lift_joint 0 0 0 y -360 360 120
elbow_joint 0.612 0 0 y -180 180 180
wrist_1_joint 0.5723 0.163941 0 y -360 360 180
wrist_2_joint 0 0 -0.1157 -z -360 360 180
wrist_3_joint 0 0.0922 0 y -360 360 180
flange 0 0 0 90 0 180
world 0 0 0 0 0 180`,
    },
    {
      id: "ur16e",
      name: "Universal Robots UR16e",
      payload: { kg: 16, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "UniversalRobots/Universal_Robots_ROS2_Description",
      path: "urdf/ur.urdf.xacro ur_type:=ur16e name:=ur",
      section: { kind: "universal-robots", model: "UR16" },
      table: `
shoulder_pan_joint 0 0 0.1807 z -360 360 120
shoulder_lift_joint 0 0 0 y -360 360 120
elbow_joint 0.4784 0 0 y -180 180 180
wrist_1_joint 0.36 0.17415 0 y -360 360 180
wrist_2_joint 0 0 -0.11985 -z -360 360 180
wrist_3_joint 0 0.11655 0 y -360 360 180
flange 0 0 0 90 0 180
world 0 0 0 0 0 180`,
    },
    {
      id: "ur20",
      name: "Universal Robots UR20",
      payload: { kg: 20, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "UniversalRobots/Universal_Robots_ROS2_Description",
      path: "urdf/ur.urdf.xacro ur_type:=ur20 name:=ur",
      section: { kind: "universal-robots", model: "UR20" },
      table: `
shoulder_pan_joint 0 0 0.2363 z -360 360 120
shoulder_lift_joint 0 0 0 y -360 360 120
elbow_joint 0.862 0 0 y -180 180 150
wrist_1_joint 0.7287 0.201 0 y -360 360 210
wrist_2_joint 0 0 -0.1593 -z -360 360 210
wrist_3_joint 0 0.1543 0 y -360 360 210
flange 0 0 0 90 0 180
world 0 0 0 0 0 180`,
    },
    {
      id: "ur30",
      name: "Universal Robots UR30",
      payload: { kg: 30, from: "designation" },
      frames: ["base_link", "tool0"],
      repository: "UniversalRobots/Universal_Robots_ROS2_Description",
      path: "urdf/ur.urdf.xacro ur_type:=ur30 name:=ur",
      section: { kind: "universal-robots", model: "UR30" },
      table: `
shoulder_pan_joint 0 0 0.2363 z -360 360 120
shoulder_lift_joint 0 0 0 y -360 360 120
elbow_joint 0.637 0 0 y -180 180 150
wrist_1_joint 0.5037 0.201 0 y -360 360 210
wrist_2_joint 0 0 -0.1593 -z -360 360 210
wrist_3_joint 0 0.1543 0 y -360 360 210
flange 0 0 0 90 0 180
world 0 0 0 0 0 180`,
    },
  ],
};
