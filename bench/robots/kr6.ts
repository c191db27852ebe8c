import {
  fromAxisAngle,
  pose,
  radians,
  type Joint,
  type OrthoParallelGeometry,
  type SerialArm,
  type Vector3,
} from "@twincell/core";

function joint(
  name: string,
  origin_m: Vector3,
  axis: Vector3,
  lower_deg: number,
  upper_deg: number,
  speed_deg_s: number,
): Joint {
  const limits = {
    lower_rad: radians(lower_deg),
    upper_rad: radians(upper_deg),
    speed_rad_s: radians(speed_deg_s),
    acceleration_rad_s2: 4 * radians(speed_deg_s),
  };
  return { name, axis, parentFromJoint: pose(origin_m), limits };
}

/**
 * KUKA KR 6 R900 sixx as its published URDF has it (ros-industrial kuka_kr6_support): zero is the arm stretched
 * forwards.
 */
export const KR6_ARM: SerialArm = {
  name: "KUKA KR 6 R900 sixx",
  joints: [
    joint("joint_a1", [0, 0, 0.4], [0, 0, -1], -170, 170, 360),
    joint("joint_a2", [0.025, 0, 0], [0, 1, 0], -190, 45, 300),
    joint("joint_a3", [0.455, 0, 0], [0, 1, 0], -120, 156, 360),
    joint("joint_a4", [0, 0, 0.035], [-1, 0, 0], -185, 185, 381),
    joint("joint_a5", [0.42, 0, 0], [0, 1, 0], -120, 120, 388),
    joint("joint_a6", [0.08, 0, 0], [-1, 0, 0], -350, 350, 615),
  ],
  lastJointFromFlange: pose([0, 0, 0], fromAxisAngle([0, 1, 0], Math.PI / 2)),
};

/** The same arm as the closed form wants it. */
export const KR6_GEOMETRY: OrthoParallelGeometry = {
  kind: "ortho-parallel",
  a1_m: 0.025,
  a2_m: -0.035,
  b_m: 0,
  c1_m: 0.4,
  c2_m: 0.455,
  c3_m: 0.42,
  c4_m: 0.08,
  offsets_rad: [0, -Math.PI / 2, 0, 0, 0, 0],
  signs: [-1, 1, 1, -1, 1, -1],
  formulaFromFlange: pose(),
};
