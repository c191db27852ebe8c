import { radians, pose, type OrthoParallelGeometry } from "@twincell/core";

/** KUKA KR 6 R900 sixx: lengths, zeros and turning senses of its data sheet and published URDF. */
export const KR6_GEOMETRY: OrthoParallelGeometry = {
  kind: "ortho-parallel",
  a1_m: 0.025, a2_m: -0.035, b_m: 0, c1_m: 0.4, c2_m: 0.455, c3_m: 0.42, c4_m: 0.08,
  offsets_rad: [0, radians(-90), 0, 0, 0, 0],
  signs: [-1, 1, 1, -1, 1, -1],
  formulaFromFlange: pose(),
};
