import type { JointLimits } from "@twincell/core";

/** Speed and ramp that are assumed where a file gives none. */
const ASSUMED_SPEED_RAD_S = Math.PI;
const RAMP_S = 0.25;

/** What a file says of a joint's limits. A speed of 0 says nothing. */
export interface GivenLimits {
  readonly lower_rad?: number | undefined;
  readonly upper_rad?: number | undefined;
  readonly speed_rad_s?: number | undefined;
  readonly acceleration_rad_s2?: number | undefined;
  readonly torque_Nm?: number | undefined;
}

/** Limits with what was not given assumed, one sentence each in `assumptions`. */
export function limitsWith(name: string, given: GivenLimits, assumptions: string[]): JointLimits {
  const isBounded = given.lower_rad !== undefined && given.upper_rad !== undefined, hasSpeed = given.speed_rad_s !== undefined && given.speed_rad_s > 0;
  const speed = hasSpeed ? given.speed_rad_s! : ASSUMED_SPEED_RAD_S;
  if (!isBounded) assumptions.push(`Joint ${name} has no limits in the file: ±360° are assumed.`);
  if (!hasSpeed) assumptions.push(`Joint ${name} has no speed in the file: 180°/s is assumed.`);
  if (given.acceleration_rad_s2 === undefined) assumptions.push(`Joint ${name} has no acceleration in the file: full speed is assumed to be reached in ${RAMP_S} s.`);
  return {
    lower_rad: isBounded ? given.lower_rad! : -2 * Math.PI, upper_rad: isBounded ? given.upper_rad! : 2 * Math.PI,
    speed_rad_s: speed, acceleration_rad_s2: given.acceleration_rad_s2 ?? speed / RAMP_S,
    ...(given.torque_Nm === undefined ? {} : { torque_Nm: given.torque_Nm }),
  };
}
