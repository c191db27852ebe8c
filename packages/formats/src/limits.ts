import { jointRateText, jointText, type Joint, type JointLimits } from "@twincell/core";

/** Speed and ramp that are assumed where a file gives none. */
const ASSUMED_SPEED_RAD_S = Math.PI;
const ASSUMED_SPEED_MPS = 0.25;
/** Travel that is assumed of a slide without limits [m]. */
const ASSUMED_TRAVEL_M = 1;
const RAMP_S = 0.25;

/** What a file says of a joint's limits, of a slide in m and m/s. A speed of 0 says nothing. */
export interface GivenLimits {
  readonly lower_rad?: number | undefined;
  readonly upper_rad?: number | undefined;
  readonly speed_rad_s?: number | undefined;
  readonly acceleration_rad_s2?: number | undefined;
  readonly torque_Nm?: number | undefined;
}

/** Limits with what was not given assumed, one sentence each in `assumptions`. */
export function limitsWith(
  name: string,
  given: GivenLimits,
  assumptions: string[],
  kind: Joint["kind"] = "revolute",
): JointLimits {
  const slides = kind === "prismatic";
  const range = slides ? ASSUMED_TRAVEL_M : 2 * Math.PI;
  const assumedSpeed = slides ? ASSUMED_SPEED_MPS : ASSUMED_SPEED_RAD_S;
  const isBounded = given.lower_rad !== undefined && given.upper_rad !== undefined;
  const hasSpeed = given.speed_rad_s !== undefined && given.speed_rad_s > 0;
  const speed = hasSpeed ? given.speed_rad_s! : assumedSpeed;
  if (!isBounded)
    assumptions.push(
      `Joint ${name} has no limits in the file: ±${jointText({ kind }, range).replace(".0", "")} are assumed.`,
    );
  if (!hasSpeed)
    assumptions.push(
      `Joint ${name} has no speed in the file: ${jointRateText({ kind }, assumedSpeed).replace(".0", "")} is assumed.`,
    );
  if (given.acceleration_rad_s2 === undefined)
    assumptions.push(
      `Joint ${name} has no acceleration in the file: full speed is assumed to be reached in ${RAMP_S} s.`,
    );
  return {
    lower_rad: isBounded ? given.lower_rad! : -range,
    upper_rad: isBounded ? given.upper_rad! : range,
    speed_rad_s: speed,
    acceleration_rad_s2: given.acceleration_rad_s2 ?? speed / RAMP_S,
    ...(given.torque_Nm === undefined ? {} : { torque_Nm: given.torque_Nm }),
  };
}
