// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const FRANKA_ROBOTICS: CatalogueMaker = {
  vendor: "Franka Robotics",
  robots: [
    {
      id: "franka_fr3",
      name: "Franka FR3",
      payload: { kg: 3, from: "data sheet" },
      home_deg: [0, -45, 0, -135, 0, 90, 45],
      frames: ["fr3_link0", "fr3_link8"],
      repository: "frankarobotics/franka_description",
      path: "robots/fr3/fr3.urdf.xacro hand:=false",
      table: `
fr3_joint1 0 0 0.333 z -157.2 157.2 150.1
fr3_joint2 0 0 0 y -102.2 102.2 150.1
fr3_joint3 0 0 0.316 z -166.2 166.2 150.1
fr3_joint4 0.0825 0 0 -y -174.3 -8.7 150.1
fr3_joint5 -0.0825 0 0.384 z -160.8 160.8 301.3758
fr3_joint6 0 0 0 -y 31.2 258.8 239.5
fr3_joint7 0.088 0 0 -z -172.8 172.8 301.3758
flange 0 0 -0.107 180 0 0`,
    },
    {
      id: "franka_fer",
      name: "Franka Panda",
      payload: { kg: 3, from: "data sheet" },
      home_deg: [0, -45, 0, -135, 0, 90, 45],
      frames: ["fer_link0", "fer_link8"],
      repository: "frankarobotics/franka_description",
      path: "robots/fer/fer.urdf.xacro hand:=false",
      table: `
fer_joint1 0 0 0.333 z -166 166 124.6
fer_joint2 0 0 0 y -101 101 124.6
fer_joint3 0 0 0.316 z -166 166 124.6
fer_joint4 0.0825 0 0 -y -176 -4 124.6
fer_joint5 -0.0825 0 0.384 z -166 166 149.542
fer_joint6 0 0 0 -y -1 215 149.542
fer_joint7 0.088 0 0 -z -166 166 149.542
flange 0 0 -0.107 180 0 0`,
    },
  ],
};
