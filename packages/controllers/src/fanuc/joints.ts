import { degrees, radians, type Robot } from "@twincell/core";

export const JOINTS = 6;
/**
 * How a controller shows the joints:
 *   J_i = degrees(q_i), but J3 = degrees(q_3 − coupling · q_2), the forearm against the horizon.
 */
export interface FanucJoints {
  readonly coupling: number;
}
const KNOWN: Readonly<Record<string, FanucJoints>> = { fanuc_lrmate200id: { coupling: 1 } };

/** Undefined for a robot whose convention is not known: it is data of the controller. */
export const fanucJoints = (robot: Robot): FanucJoints | undefined => KNOWN[robot.id];

export function shownOf(q_rad: ArrayLike<number>, { coupling }: FanucJoints, out: Float64Array): Float64Array {
  for (let i = 0; i < JOINTS; i++) out[i] = degrees(i === 2 ? q_rad[2]! - coupling * q_rad[1]! : q_rad[i]!);
  return out;
}
export function jointsOf(j_deg: ArrayLike<number>, { coupling }: FanucJoints, out: Float64Array): Float64Array {
  for (let i = 0; i < JOINTS; i++) out[i] = radians(j_deg[i]!);
  out[2]! += coupling * out[1]!;
  return out;
}
