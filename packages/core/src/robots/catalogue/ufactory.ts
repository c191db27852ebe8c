// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const UFACTORY: CatalogueMaker = {
  vendor: "UFACTORY",
  robots: [
    {
      id: "ufactory_xarm6",
      name: "UFACTORY xArm 6",
      payload: { kg: 5, from: "data sheet" },
      home_deg: [0, -30, -40, 0, 70, 0],
      frames: ["link_base", "link_eef"],
      repository: "xArm-Developer/xarm_ros2",
      path: "xarm_description/urdf/xarm_device.urdf.xacro dof:=6 robot_type:=xarm",
      table: `
joint1 0 0 0.267 z -360 360 179.9
joint2 0 0 0 y -117.972 120 179.9
joint3 0.0535 0 0.2845 y -225 11 179.9
joint4 0.0775 0 -0.3425 -z -360 360 179.9
joint5 0 0 0 y -97 180 179.9
joint6 0.076 0 -0.097 -z -360 360 179.9
flange 0 0 0 180 0 0`,
    },
    {
      id: "ufactory_xarm7",
      name: "UFACTORY xArm 7",
      payload: { kg: 3.5, from: "data sheet" },
      home_deg: [0, -30, 0, 60, 0, 90, 0],
      frames: ["link_base", "link_eef"],
      repository: "xArm-Developer/xarm_ros2",
      path: "xarm_description/urdf/xarm_device.urdf.xacro dof:=7 robot_type:=xarm",
      table: `
joint1 0 0 0.267 z -360 360 179.9
joint2 0 0 0 y -117.972 120 179.9
joint3 0 0 0.293 z -360 360 179.9
joint4 0.0525 0 0 -y -11 225 179.9
joint5 0.0775 0 -0.3425 -z -360 360 179.9
joint6 0 0 0 y -97 180 179.9
joint7 0.076 0 -0.097 -z -360 360 179.9
flange 0 0 0 180 0 0`,
    },
    {
      id: "ufactory_lite6",
      name: "UFACTORY Lite 6",
      payload: { kg: 0.6, from: "data sheet" },
      frames: ["link_base", "link_eef"],
      repository: "xArm-Developer/xarm_ros2",
      path: "xarm_description/urdf/xarm_device.urdf.xacro dof:=6 robot_type:=lite",
      table: `
joint1 0 0 0.2435 z -360 360 179.9
joint2 0 0 0 y -150 150 179.9
joint3 0 0 0.2002 -y -3.5 300 179.9
joint4 0.087 0 -0.22761 -z -360 360 179.9
joint5 0 0 0 y -124 124 179.9
joint6 0 0 -0.0625 -z -360 360 179.9
flange 0 0 0 180 0 0`,
    },
  ],
};
