import type { Robot } from "@twincell/core";

/**
 * How the pendant shows the joints of a robot:
 *   J_i = degrees(q_i), but J3 = degrees(q_3 − factor · q_2): the forearm against
 * the horizon. A robot without a line is refused instead of guessed.
 */
export interface PendantConvention {
  readonly coupling: number;
}

const ROBOTS: Readonly<Record<string, PendantConvention>> = {
  fanuc_lrmate200id: { coupling: 1 },
};

/** Undefined for a robot whose controller does not speak TP. */
export const pendantConvention = (robot: Robot): PendantConvention | undefined => ROBOTS[robot.id];

/** The output of the hand that closes the gripper while it is on. */
export const GRIPPER_OUTPUT = "RO[1]";
