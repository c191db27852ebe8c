import { branchOf, degrees, type Robot } from "@twincell/core";

/**
 * The posture word of a position: bit 0 rear, 1 lower arm, 2 no flip, 3 R, 4 T, 5 S from half a turn on.
 * Flip is told by the angle of R, rear and lower arm by where the wrist and axis U are.
 */
export function formOf(robot: Robot, q_rad: ArrayLike<number>): number {
  const branch = branchOf(robot, q_rad);
  const r = Math.abs(degrees(q_rad[3]!)) % 360;
  const flags = [
    branch?.shoulder === "back",
    branch?.elbow === "down",
    r > 90 && r < 270,
    fromHalfATurn(q_rad[3]!),
    fromHalfATurn(q_rad[5]!),
    fromHalfATurn(q_rad[0]!),
  ];
  return flags.reduce((word, is, bit) => (is ? word | (1 << bit) : word), 0);
}
const fromHalfATurn = (q_rad: number): boolean => Math.abs(degrees(q_rad)) >= 180;
