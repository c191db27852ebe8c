import type {
  GeneralSixGeometry,
  OrthoParallelGeometry,
  Robot,
  SphericalSevenGeometry,
  ThreeParallelGeometry,
} from "../model/robot.ts";
import { rotate } from "../spatial/quaternion.ts";
import { wrapAngle } from "../spatial/units.ts";
import { determinantSign } from "./determinant.ts";
import { elbowOfSphericalSeven } from "./spherical-seven.ts";

/**
 * Which of the arm's postures. Named as a person sees them; vendors' own words live in their dialect.
 * shoulder: the wrist is in front of the shoulder axis or behind it; of seven joints: joint 2 bends forwards or
 * backwards. elbow: above or below the line shoulder–wrist, as the arm stands when it faces the wrist; of seven joints:
 * the sign of joint 4. wrist: sign of the wrist-bend angle in the formula's zero.
 */
export interface Branch {
  readonly shoulder: "front" | "back";
  readonly elbow: "up" | "down";
  readonly wrist: "positive" | "negative";
  /**
   * Sign of det J, for arms without spherical wrist: up to 16 postures share eight names, and only a singularity
   * changes this one. Two postures may still share all four names (the arm can go from one to the other without a
   * singularity): then the nearer is meant.
   */
  readonly determinant?: "positive" | "negative";
  /**
   * Where the elbow of seven joints stands on its circle [rad]. A place, not a name: `sameBranch` does not compare it.
   */
  readonly elbow_rad?: number;
}

export const sameBranch = (a: Branch, b: Branch): boolean =>
  a.shoulder === b.shoulder &&
  a.elbow === b.elbow &&
  a.wrist === b.wrist &&
  (a.determinant === undefined || b.determinant === undefined || a.determinant === b.determinant);

/**
 * The branch of a posture; undefined for arms whose family has no such names. On a border (stretched, straight) either
 * name is right.
 */
export function branchOf(robot: Robot, q_rad: ArrayLike<number>, at = 0): Branch | undefined {
  const family = robot.family;
  switch (family.kind) {
    case "ortho-parallel":
      return branchOfOrthoParallel(family, q_rad, at);
    case "three-parallel":
      return branchOfThreeParallel(family, q_rad, at);
    case "spherical-seven":
      return branchOfSphericalSeven(family, q_rad, at);
    case "general-6r":
      return {
        ...branchOfGeneralSix(family, q_rad, at),
        determinant: determinantSign(robot.arm, q_rad, at) < 0 ? "negative" : "positive",
      };
    case "general":
      return undefined;
  }
}

/**
 * The wrist of a branch whose axis 5 the controller shows above 0: branches name the sign of θ5 in the formula's own
 * zero, which turns the other way for some arms. "positive" where no section says how axes are shown.
 */
export function wristAboveZero({ family, vendorSection }: Robot): Branch["wrist"] {
  const turns = family.kind === "general" ? 1 : family.signs[4];
  return turns * (vendorSection?.axes[4]?.sign ?? 1) > 0 ? "positive" : "negative";
}

const named = (front: boolean, up: boolean, positive: boolean): Branch => ({
  shoulder: front ? "front" : "back",
  elbow: up ? "up" : "down",
  wrist: positive ? "positive" : "negative",
});

/**
 * Shoulder by the sign of the wrist centre's distance in front of axis 1, elbow by the sign of φ = θ3 + atan2(a2, c3)
 * (seen from behind when the shoulder is back), wrist by the sign of θ5.
 *
 * @param at  index of the first of the six angles in `q_rad`.
 */
export function branchOfOrthoParallel(geometry: OrthoParallelGeometry, q_rad: ArrayLike<number>, at = 0): Branch {
  const { signs, offsets_rad, a1_m, a2_m, c2_m, c3_m } = geometry;
  const t2 = signs[1] * q_rad[at + 1]! - offsets_rad[1];
  const t3 = signs[2] * q_rad[at + 2]! - offsets_rad[2];
  const t5 = wrapAngle(signs[4] * q_rad[at + 4]! - offsets_rad[4]);
  const bend0 = Math.atan2(a2_m, c3_m);
  const k = Math.sqrt(a2_m * a2_m + c3_m * c3_m);
  const phi = wrapAngle(t3 + bend0);
  const front = a1_m + c2_m * Math.sin(t2) + k * Math.sin(t2 + phi) >= 0;
  return named(front, phi >= 0 === front, t5 >= 0);
}

/** Shoulder by where the meeting of axes 5 and 6 is, elbow by the sign of θ3, wrist by that of θ5. */
export function branchOfThreeParallel(
  { signs, offsets_rad, a1_m, c2_m, c3_m, c5_m }: ThreeParallelGeometry,
  q_rad: ArrayLike<number>,
  at = 0,
): Branch {
  const t2 = signs[1] * q_rad[at + 1]! - offsets_rad[1];
  const t3 = wrapAngle(signs[2] * q_rad[at + 2]! - offsets_rad[2]);
  const t4 = signs[3] * q_rad[at + 3]! - offsets_rad[3];
  const front = a1_m + c2_m * Math.sin(t2) + c3_m * Math.sin(t2 + t3) + c5_m * Math.sin(t2 + t3 + t4) >= 0;
  return named(front, t3 >= 0 === front, wrapAngle(signs[4] * q_rad[at + 4]! - offsets_rad[4]) >= 0);
}

/** The signs of θ2, θ4 and θ6, and the elbow angle. */
export function branchOfSphericalSeven(geometry: SphericalSevenGeometry, q_rad: ArrayLike<number>, at = 0): Branch {
  const { signs, offsets_rad } = geometry;
  const positive = (j: number): boolean => wrapAngle(signs[j]! * q_rad[at + j]! - offsets_rad[j]!) >= 0;
  return { ...named(positive(1), positive(3), positive(5)), elbow_rad: elbowOfSphericalSeven(geometry, q_rad, at) };
}

/**
 * Shoulder and elbow as in an ortho-parallel arm, by where axes 4 and 5 meet; wrist by the side of axis 5 that axis 6
 * is turned to from axis 4.
 */
function branchOfGeneralSix(
  { signs, offsets_rad, a1_m, c2_m, centre_m, axis4: u, axis5: h, turn }: GeneralSixGeometry,
  q_rad: ArrayLike<number>,
  at: number,
): Branch {
  const t2 = signs[1] * q_rad[at + 1]! - offsets_rad[1];
  const t3 = signs[2] * q_rad[at + 2]! - offsets_rad[2];
  const t5 = signs[4] * q_rad[at + 4]! - offsets_rad[4];
  const k = Math.hypot(...centre_m);
  const phi = wrapAngle(t3 + Math.atan2(centre_m[0], centre_m[1]));
  const front = a1_m + c2_m * Math.sin(t2) + k * Math.sin(t2 + phi) >= 0;
  // axis5 · (axis4 × Rot(axis5, θ5) axis6), with axis 6 split into its parts along and across axis 5.
  const tip = rotate(turn, [0, 0, 1]);
  const along = h[0] * tip[0] + h[1] * tip[1] + h[2] * tip[2];
  const ax = tip[0] - along * h[0];
  const ay = tip[1] - along * h[1];
  const az = tip[2] - along * h[2];
  const bx = h[1] * az - h[2] * ay;
  const by = h[2] * ax - h[0] * az;
  const bz = h[0] * ay - h[1] * ax;
  const c = Math.cos(t5);
  const s = Math.sin(t5);
  const wx = c * ax + s * bx;
  const wy = c * ay + s * by;
  const wz = c * az + s * bz;
  const side = h[0] * (u[1] * wz - u[2] * wy) + h[1] * (u[2] * wx - u[0] * wz) + h[2] * (u[0] * wy - u[1] * wx);
  return named(front, phi >= 0 === front, side >= 0);
}
