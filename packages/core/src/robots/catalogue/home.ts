import { flangePose } from "../../kinematics/forward.ts";
import { rotate } from "../../spatial/quaternion.ts";
import type { SerialArm } from "../../model/arm.ts";
import type { KinematicFamily } from "../../model/robot.ts";

const HALF = Math.PI / 2;
const TURN = 2 * Math.PI;

/**
 * Where an arm of the catalogue starts, away from singular postures: the upper arm upright, the forearm level, the tool
 * down as far as the limits allow, where the closed form says which angles these are; else every second joint is bent
 * by 45°.
 */
export function homeOf(arm: SerialArm, family: KinematicFamily): readonly number[] {
  if (family.kind === "general")
    return within(
      arm,
      arm.joints.map((_, j) => (j % 2 === 1 ? Math.PI / 4 : 0)),
    );
  const { signs, offsets_rad } = family;
  const homes = formulaHomes(family).map(angles =>
    within(
      arm,
      angles.map((angle, j) => signs[j]! * (angle + offsets_rad[j]!)),
    ),
  );
  return homes.reduce((best, home) => (toolDown(arm, home) > toolDown(arm, best) + 1e-6 ? home : best));
}

/** Angles of the formula that lay the forearm level and turn the wrist by right angles, the usual one first. */
function formulaHomes(family: Exclude<KinematicFamily, { readonly kind: "general" }>): readonly (readonly number[])[] {
  switch (family.kind) {
    case "ortho-parallel":
      return [HALF, -HALF].map(fifth => [0, 0, HALF, 0, fifth, 0]);
    case "three-parallel":
      return [0, HALF, -HALF, Math.PI].flatMap(fourth => [HALF, -HALF].map(fifth => [0, 0, HALF, fourth, fifth, 0]));
    case "general-6r": {
      const [x, z] = family.centre_m;
      const level = Math.atan2(z, x);
      return [0, HALF, -HALF].flatMap(fourth => [HALF, -HALF, 0].map(fifth => [0, 0, level, fourth, fifth, 0]));
    }
    case "spherical-seven":
      return [[0, Math.PI / 6, 0, -HALF, 0, HALF / 2, 0]];
  }
}

/** 1 where the tool looks straight down. */
const toolDown = (arm: SerialArm, q_rad: readonly number[]): number =>
  -rotate(flangePose(arm, q_rad).quaternion, [0, 0, 1])[2];

/** The same directions, within the limits where a whole turn more or less leads there, else at the nearer limit. */
const within = ({ joints }: SerialArm, q_rad: readonly number[]): readonly number[] =>
  q_rad.map((angle, j) => {
    const { lower_rad, upper_rad } = joints[j]!.limits;
    const near = angle - TURN * Math.round(angle / TURN);
    const turns = [near, near - TURN, near + TURN];
    const inside = turns.find(each => each >= lower_rad && each <= upper_rad);
    const found = inside ?? Math.min(upper_rad, Math.max(lower_rad, near));
    return Math.abs(found) < 1e-12 ? 0 : found;
  });
