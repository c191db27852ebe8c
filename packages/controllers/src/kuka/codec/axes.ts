import {
  flangePose,
  fromKukaAbc,
  pose,
  radians,
  toKukaAbc,
  type Pose,
  type Robot,
  type VendorSection,
  sectionForDriver,
} from "@twincell/core";
import { krlStruct, partsIn, REAL_DIGITS } from "./values.ts";

export const AXES = 6;
export const AXIS_NAMES = ["A1", "A2", "A3", "A4", "A5", "A6"] as const;
const FRAME_NAMES = ["X", "Y", "Z", "A", "B", "C"] as const;

/** The axes of a robot that KUKA's controllers move; undefined for others. */
export function kukaAxes(robot: Robot): VendorSection | undefined {
  const section = sectionForDriver(robot, "kuka", "kuka-rsi");
  return robot.arm.joints.length === AXES ? section : undefined;
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
