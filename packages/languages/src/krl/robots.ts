import type { Robot } from "@twincell/core";

/**
 * How a KUKA controller counts the axes of a robot:  A_deg = sign · degrees(q) + offset_deg.  One line per robot whose
 * controller speaks KRL; a robot without a line is refused instead of guessed. (The LBR iiwa speaks Java.)
 */
export interface AxisConvention {
  readonly signs: readonly number[];
  readonly offsets_deg: readonly number[];
}

/** The library's joints are KUKA's axes: zero with the arm level in front, A1, A4 and A6 by the left hand. */
const AS_IN_LIBRARY: AxisConvention = { signs: [1, 1, 1, 1, 1, 1], offsets_deg: [0, 0, 0, 0, 0, 0] };
const CONVENTIONS: Readonly<Record<string, AxisConvention>> = {
  kuka_kr6r900sixx: AS_IN_LIBRARY,
  kuka_kr6_2: AS_IN_LIBRARY,
};

export const axisConvention = (robot: Robot): AxisConvention | undefined => CONVENTIONS[robot.id];
