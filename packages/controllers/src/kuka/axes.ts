import { degrees, flangePose, fromKukaAbc, pose, radians, toKukaAbc, type Pose, type Robot } from "@twincell/core";
import { krlStruct, partsIn, REAL_DIGITS } from "./codec-values.ts";

/**
 * How a controller counts the axes:
 *   A_i = sign_i · degrees(q_i) + offset_i.
 * Data of the controller: handed in for arms that are described otherwise.
 */
export interface KukaAxes {
  readonly signs: readonly number[];
  readonly offsets_deg: readonly number[];
}
export const AXES = 6;
export const AXIS_NAMES = ["A1", "A2", "A3", "A4", "A5", "A6"] as const;
const FRAME_NAMES = ["X", "Y", "Z", "A", "B", "C"] as const;

/**
 * The library describes KUKA's arms by KUKA's own axes: zero with the arm level in front, A1, A4 and A6 by the left
 * hand. Undefined where that is not known.
 */
export const kukaAxes = (robot: Robot): KukaAxes | undefined =>
  robot.vendor === "KUKA" && robot.arm.joints.length === AXES
    ? { signs: [1, 1, 1, 1, 1, 1], offsets_deg: [0, 0, 0, 0, 0, 0] }
    : undefined;

export function axesOf(q_rad: ArrayLike<number>, axes: KukaAxes, out: Float64Array): Float64Array {
  for (let i = 0; i < AXES; i++) out[i] = axes.signs[i]! * degrees(q_rad[i]!) + axes.offsets_deg[i]!;
  return out;
}
export function jointsOf(a_deg: ArrayLike<number>, axes: KukaAxes, out: Float64Array): Float64Array {
  for (let i = 0; i < AXES; i++) out[i] = radians((a_deg[i]! - axes.offsets_deg[i]!) * axes.signs[i]!);
  return out;
}

/** `{E6AXIS: A1 …, E6 0.0}`. Every axis is there: a component left out would keep its present value. */
export const e6axis = (a_deg: ArrayLike<number>, digits = REAL_DIGITS): string =>
  krlStruct("E6AXIS", [...AXIS_NAMES.map((name, i) => [name, a_deg[i]!] as const), ...OUTER], digits);
const OUTER = ["E1", "E2", "E3", "E4", "E5", "E6"].map(name => [name, 0] as const);

/** `{E6POS: X …, S, T, E1 …}` in mm and degrees; S and T only where they are given. */
export function e6pos(
  { position, quaternion }: Pose,
  configuration: { readonly s: number; readonly t: number } | null,
  digits = REAL_DIGITS,
): string {
  const [a, b, c] = toKukaAbc(quaternion);
  const values = [1000 * position[0], 1000 * position[1], 1000 * position[2], a, b, c];
  const turn = configuration
    ? ([
        ["S", configuration.s],
        ["T", configuration.t],
      ] as const)
    : [];
  return krlStruct("E6POS", [...FRAME_NAMES.map((name, i) => [name, values[i]!] as const), ...turn, ...OUTER], digits, [
    "S",
    "T",
  ]);
}
/** Undefined when a component is missing or is no number. */
export function poseIn(text: string): Pose | undefined {
  const v = new Float64Array(6);
  return partsIn(text, FRAME_NAMES, v)
    ? pose([v[0]! / 1000, v[1]! / 1000, v[2]! / 1000], fromKukaAbc(v[3]!, v[4]!, v[5]!))
    : undefined;
}

/** Status and Turn of a posture: overhead, A3 beyond the stretched arm, A5 negative; and which axes are negative. */
export function statusAndTurn(robot: Robot, a_deg: ArrayLike<number>): { s: number; t: number } {
  let t = 0;
  for (let i = 0; i < AXES; i++) if (a_deg[i]! < 0) t |= 1 << i;
  const { family } = robot;
  if (family.kind !== "ortho-parallel") return { s: a_deg[4]! < 0 ? 4 : 0, t };
  const { a1_m, a2_m, c2_m, c3_m } = family;
  const a2 = radians(a_deg[1]!);
  const a3 = radians(a_deg[2]!);
  // Level is A2 = 0; the forearm goes on from there, its wrist off to the side by a2.
  const ahead_m = a1_m + c2_m * Math.cos(a2) + c3_m * Math.cos(a2 + a3) - a2_m * Math.sin(a2 + a3);
  const bent_m = c3_m * Math.sin(a3) + a2_m * Math.cos(a3);
  return { s: (ahead_m < 0 ? 1 : 0) | (bent_m > 0 ? 2 : 0) | (a_deg[4]! < 0 ? 4 : 0), t };
}
export const flangeText = (
  robot: Robot,
  q_rad: ArrayLike<number>,
  a_deg: ArrayLike<number>,
  digits = REAL_DIGITS,
): string => e6pos(flangePose(robot.arm, q_rad), statusAndTurn(robot, a_deg), digits);
