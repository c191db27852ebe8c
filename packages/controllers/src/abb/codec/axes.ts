import { plainAxes, sectionForDriver, type AxisCounting, type Robot } from "@twincell/core";

/**
 * How a controller counts the axes of a robot, by its vendor section. One without is counted as its file does: nobody
 * drives it, `DriverKind` says so before.
 */
export const abbAxes = (robot: Robot): AxisCounting =>
  sectionForDriver(robot, "abb", "abb-egm") ?? { axes: plainAxes(robot.arm.joints.map(({ name }) => name)) };
