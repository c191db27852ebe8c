import { countsAsFile, sectionForDriver, type Robot } from "@twincell/core";

/** ros_server moves arms of so many joints. */
export const JOINTS = 6;

/**
 * simple_message says the joint angles of a robot's own file as they are: the section of a robot it moves has no sign,
 * zero or coupling.
 */
export function speaksSimpleMessage(robot: Robot): boolean {
  const section = sectionForDriver(robot, "staubli");
  return robot.arm.joints.length === JOINTS && section !== undefined && countsAsFile(section);
}
