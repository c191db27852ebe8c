import type { OrthoParallelGeometry, Robot } from "../robots/robot.ts";
import { wrapAngle } from "../spatial/units.ts";

/**
 * Which of the (up to) eight arm postures. Named as a person sees them; vendors' own words live in their dialect.
 * shoulder: the wrist centre is in front of the shoulder axis or behind it. elbow: above or below the line
 * shoulder–wrist, as the arm stands when it faces the wrist. wrist: sign of the wrist-bend angle in the formula's zero.
 */
export interface Branch {
  readonly shoulder: "front" | "back";
  readonly elbow: "up" | "down";
  readonly wrist: "positive" | "negative";
}

export const sameBranch = (a: Branch, b: Branch): boolean => a.shoulder === b.shoulder && a.elbow === b.elbow && a.wrist === b.wrist;

/** The branch of a posture; undefined for arms whose family has no such names. On a border (stretched, straight) either name is right. */
export function branchOf(robot: Robot, q_rad: ArrayLike<number>, at = 0): Branch | undefined {
  return robot.family.kind === "ortho-parallel" ? branchOfOrthoParallel(robot.family, q_rad, at) : undefined;
}

/**
 * Shoulder by the sign of the wrist centre's distance in front of axis 1, elbow by the sign of φ = θ3 + atan2(a2, c3)
 * (seen from behind when the shoulder is back), wrist by the sign of θ5.
 *
 * @param at  index of the first of the six angles in `q_rad`.
 */
export function branchOfOrthoParallel(geometry: OrthoParallelGeometry, q_rad: ArrayLike<number>, at = 0): Branch {
  const { signs, offsets_rad, a1_m, a2_m, c2_m, c3_m } = geometry;
  const t2 = signs[1] * q_rad[at + 1]! - offsets_rad[1], t3 = signs[2] * q_rad[at + 2]! - offsets_rad[2];
  const t5 = wrapAngle(signs[4] * q_rad[at + 4]! - offsets_rad[4]);
  const bend0 = Math.atan2(a2_m, c3_m), k = Math.sqrt(a2_m * a2_m + c3_m * c3_m), phi = wrapAngle(t3 + bend0);
  const ahead = a1_m + c2_m * Math.sin(t2) + k * Math.sin(t2 + phi);
  const front = ahead >= 0;
  return { shoulder: front ? "front" : "back", elbow: (phi >= 0) === front ? "up" : "down", wrist: t5 >= 0 ? "positive" : "negative" };
}
