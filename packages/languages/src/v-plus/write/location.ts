import { degrees, millimetres, type JointLimits, type Pose, type Quaternion, type Robot } from "@twincell/core";
import { singleText } from "../../text/index.ts";
import type { JointConvention } from "../robots.ts";

/** Below this sine of the half angle, pitch is 0 or 180° and only yaw ± roll is defined. */
const FLAT = 1e-9;

/**
 * Yaw, pitch and roll [rad] of R = Rz(yaw) · Ry(pitch) · Rz(roll), pitch in [0, π], from
 *
 *   w, z = cos(pitch/2) · (cos, sin)((yaw + roll)/2)      y, −x = sin(pitch/2) · (cos, sin)((yaw − roll)/2)
 *
 * At pitch 0 or 180° roll is 0.
 */
export function yawPitchRoll([x, y, z, w]: Quaternion): [number, number, number] {
  const upright = Math.hypot(z, w), tilted = Math.hypot(x, y);
  const pitch = 2 * Math.atan2(tilted, upright);
  if (tilted < FLAT) return [wrapped(2 * Math.atan2(z, w)), pitch, 0];
  if (upright < FLAT) return [wrapped(2 * Math.atan2(-x, y)), pitch, 0];
  const sum = Math.atan2(z, w), difference = Math.atan2(-x, y);
  return [wrapped(sum + difference), pitch, wrapped(sum - difference)];
}

const wrapped = (angle: number): number => angle > Math.PI ? angle - 2 * Math.PI : angle <= -Math.PI ? angle + 2 * Math.PI : angle;

/** TRANS(x,y,z,yaw,pitch,roll) in mm and degrees. */
export function transText({ position, quaternion }: Pose): string {
  const numbers = [...position.map(millimetres), ...yawPitchRoll(quaternion).map(degrees)];
  return `TRANS(${numbers.map(tidy).join(",")})`;
}

/** #PPOINT(j1,…,jn) in degrees as V+ counts them: no blanks, ASCII minus, seven significant digits, no exponent (rows N-54 … N-56). */
export function ppointText(q_rad: ArrayLike<number>, { signs, offsets_deg }: JointConvention): string {
  return `#PPOINT(${Array.from(q_rad, (q, i) => singleText(signs[i]! * degrees(q) + offsets_deg[i]!)).join(",")})`;
}

/** A millionth of a millimetre or of a degree is arithmetic, not a wish. */
const tidy = (value: number): string => singleText(Math.abs(value) < 1e-6 ? 0 : value);

/** The first joint, from 1, outside its limits; undefined when all are inside. */
export function jointOutside(robot: Robot, q_rad: ArrayLike<number>): { readonly joint: number; readonly limits: JointLimits } | undefined {
  const i = robot.arm.joints.findIndex(({ limits }, k) => !(q_rad[k]! >= limits.lower_rad - LIMIT_SLACK_RAD && q_rad[k]! <= limits.upper_rad + LIMIT_SLACK_RAD));
  return i < 0 ? undefined : { joint: i + 1, limits: robot.arm.joints[i]!.limits };
}
const LIMIT_SLACK_RAD = 1e-9;
