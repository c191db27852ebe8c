import type { Robot } from "@twincell/core";

/**
 * Robots whose controllers speak URScript, with the joint speed at which all their joints can turn [rad/s]: full speed
 * of a joint move. Joint angles are those of the library: the arm lies stretched out at 0, every joint turns
 * right-handed.
 */
const FULL_SPEED_RAD_S: Readonly<Record<string, number>> = {
  ur10e: (2 * Math.PI) / 3,
};

/** Full joint speed [rad/s], or undefined for a robot whose controller does not speak URScript. */
export const fullJointSpeed = (robot: Robot): number | undefined => FULL_SPEED_RAD_S[robot.id];

/**
 * Digital lines of the control box and the tool by their number in the program: 0 … 7 standard, 8 … 15 configurable, 16
 * and 17 at the tool.
 */
export const DIGITAL_LINES = { standard: 8, configurable: 8, tool: 2 } as const;
/** The output that closes the gripper when it is on: number 0 at the tool. */
export const GRIPPER_TOOL_OUTPUT = 0;
