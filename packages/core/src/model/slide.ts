import { degrees, millimetres } from "../spatial/units.ts";
import type { Joint, JointLimits } from "./arm.ts";

/** Limits of a joint that slides, in its own units. */
export interface SlideLimits {
  readonly lower_m: number;
  readonly upper_m: number;
  readonly speed_mps: number;
  readonly acceleration_mps2: number;
  readonly jerk_mps3?: number;
  /** Greatest force along the axis, where it is published [N]. */
  readonly force_N?: number;
}

/**
 * Limits of a sliding joint as `Joint.limits` holds them (docs/decisions/0012): the same numbers, metres for radians.
 */
export const slideLimits = ({
  lower_m,
  upper_m,
  speed_mps,
  acceleration_mps2,
  jerk_mps3,
  force_N,
}: SlideLimits): JointLimits => ({
  lower_rad: lower_m,
  upper_rad: upper_m,
  speed_rad_s: speed_mps,
  acceleration_rad_s2: acceleration_mps2,
  ...(jerk_mps3 === undefined ? {} : { jerk_rad_s3: jerk_mps3 }),
  ...(force_N === undefined ? {} : { torque_Nm: force_N }),
});

/** Whether the joint is moved along its axis and not about it. */
export const isSlide = (joint: Pick<Joint, "kind">): boolean => joint.kind === "prismatic";

/** A value of the joint as people read it: “12.0°”, of a slide “250.0 mm”. */
export const jointText = (joint: Pick<Joint, "kind">, value: number): string =>
  isSlide(joint) ? `${millimetres(value).toFixed(1)} mm` : `${degrees(value).toFixed(1)}°`;

/** A speed of the joint as people read it: “12.0°/s”, of a slide “250.0 mm/s”. */
export const jointRateText = (joint: Pick<Joint, "kind">, speed: number): string => `${jointText(joint, speed)}/s`;

/** What the joint is said to do on its way to a value. */
export const movesTo = (joint: Pick<Joint, "kind">): "slide to" | "turn to" =>
  isSlide(joint) ? "slide to" : "turn to";

/** The farthest the joints may slide together [m]; 0 for an arm that only turns. */
export const slideOf = (joints: readonly Joint[]): number =>
  joints.reduce(
    (sum, joint) =>
      sum + (isSlide(joint) ? Math.max(Math.abs(joint.limits.lower_rad), Math.abs(joint.limits.upper_rad)) : 0),
    0,
  );
