import type { JointLimits } from "./arm.ts";
import type { Robot } from "./robot.ts";

/** Seconds in which a joint is assumed to go from no acceleration to its full one, where its jerk is not published. */
export const JERK_RAMP_S = 0.1;

/** Jerk a joint is planned with [rad/s³]. */
export const jerkOf = (limits: JointLimits): number => limits.jerk_rad_s3 ?? limits.acceleration_rad_s2 / JERK_RAMP_S;

/** What a plan's durations rest on beside `Robot.assumptions`, one sentence each. */
export const motionAssumptions = (robot: Robot): string[] =>
  robot.arm.joints.every(({ limits }) => limits.jerk_rad_s3 !== undefined)
    ? []
    : [`Joint jerks are not published: full joint acceleration is assumed to be reached in ${JERK_RAMP_S} s.`];

/** Longest time from the command to stop hard, as fast as the accelerations allow, until every joint stands [s]. */
export const hardBrakingTime_s = (robot: Robot): number =>
  Math.max(...robot.arm.joints.map(({ limits }) => limits.speed_rad_s / limits.acceleration_rad_s2));

/**
 * The same for a stop that spares the gears: at worst full acceleration is taken back, turned round and let go again,
 * each within the jerk.
 */
export const brakingTime_s = (robot: Robot): number =>
  Math.max(
    ...robot.arm.joints.map(
      ({ limits }) =>
        limits.speed_rad_s / limits.acceleration_rad_s2 + (2 * limits.acceleration_rad_s2) / jerkOf(limits),
    ),
  );

/**
 * What the tool travels at most from the word to stop to standstill [m]:
 *   v t_reaction + v t_braking / 2, all joints slowing down evenly.
 *
 * @param speed_mps   speed of the tool when the word comes.
 * @param reaction_s  from the word to the first slowing down.
 */
export const brakingDistance_m = (robot: Robot, speed_mps: number, reaction_s = 0.02): number =>
  speed_mps * (reaction_s + hardBrakingTime_s(robot) / 2);
