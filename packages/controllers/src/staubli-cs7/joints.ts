import { degrees, radians, type Robot } from "@twincell/core";

export const JOINTS = 6;
/** How V+ counts the joints:  joint_deg = degrees(q) + offset_deg. */
export interface VPlusJoints {
  readonly offsets_deg: readonly number[];
}
const KNOWN: Readonly<Record<string, VPlusJoints>> = { staubli_rx90l: { offsets_deg: [0, 0, 0, 0, 0, 0] } };

/** Undefined for a robot of which it is not known. */
export const vPlusJoints = (robot: Robot): VPlusJoints | undefined => KNOWN[robot.id];
export function shownOf(q_rad: ArrayLike<number>, { offsets_deg }: VPlusJoints, out: Float64Array): Float64Array {
  for (let i = 0; i < JOINTS; i++) out[i] = degrees(q_rad[i]!) + offsets_deg[i]!;
  return out;
}
export function jointsOf(joints_deg: ArrayLike<number>, { offsets_deg }: VPlusJoints, out: Float64Array): Float64Array {
  for (let i = 0; i < JOINTS; i++) out[i] = radians(joints_deg[i]! - offsets_deg[i]!);
  return out;
}
