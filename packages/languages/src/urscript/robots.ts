import { countsAsFile, sectionForLanguage, type Robot } from "@twincell/core";

/**
 * Joint speed at which all joints of an arm can turn [rad/s]: full speed of a joint move. Undefined for a robot whose
 * controllers do not run URScript, or count its joints otherwise than its file does: URScript has no zero and no sign
 * to set.
 */
export function fullJointSpeed(robot: Robot): number | undefined {
  const section = sectionForLanguage(robot, "urscript");
  return section !== undefined && countsAsFile(section)
    ? Math.min(...robot.arm.joints.map(({ limits }) => limits.speed_rad_s))
    : undefined;
}

/**
 * Digital lines of the control box and the tool by their number in the program: 0 … 7 standard, 8 … 15 configurable, 16
 * and 17 at the tool.
 */
export const DIGITAL_LINES = { standard: 8, configurable: 8, tool: 2 } as const;
/** The output that closes the gripper when it is on: number 0 at the tool. */
export const GRIPPER_TOOL_OUTPUT = 0;
