// Written by scripts/catalogue/write.ts; do not edit.

/** Repository of robot descriptions → its licence and the commit that was read. */
export const REPOSITORIES: Readonly<Record<string, string>> = {
  "kroshu/kuka_robot_descriptions": "Apache-2.0, commit 7766e92",
  "ros-industrial/motoman": "BSD-3-Clause, commit 433be15",
  "FANUC-CORPORATION/fanuc_description": "Apache-2.0, commit 250d3fa",
  "ros-industrial/abb_experimental": "Apache-2.0 and BSD, commit 20b9cf8",
  "ros-industrial/abb": "Apache-2.0 and BSD, commit 77db19b",
  "ros-industrial/staubli_experimental": "Apache-2.0, commit 256a71a",
  "Kawasaki-Robotics/khi_robot": "BSD-3-Clause, commit 57200db",
  "Mitsubishi-Electric-Asia/melfa_ros2_driver": "Apache-2.0, commit 8a52cd2",
  "DoosanRobotics/doosan-robot2": "BSD-3-Clause, commit ec92425",
  "TechmanRobotInc/tmr_ros2": "BSD-3-Clause, commit 684faab",
  "Dobot-Arm/DOBOT_6Axis_ROS2_V4": "MIT, commit a1eabef",
  "xArm-Developer/xarm_ros2": "BSD-3-Clause, commit 3654ba7",
  "frankarobotics/franka_description": "Apache-2.0, commit 566ba44",
  "Kinovarobotics/ros2_kortex": "BSD-3-Clause, commit 1fdbef3",
  "AuboRobot/aubo_robot": "BSD, commit 6709931",
  "RethinkRobotics/sawyer_robot": "Apache-2.0, commit d1ef3d0",
  "DENSORobot/denso_robot_ros2": "MIT, commit 071363c",
  "UniversalRobots/Universal_Robots_ROS2_Description": "BSD-3-Clause, commit 2221ec0",
};
