import type { Robot } from "@twincell/core";

/** ros_server moves arms of so many joints. */
export const JOINTS = 6;
/** Robots of the library that count their joints otherwise than VAL 3 does: all zero stands straight up there. */
const OTHERWISE: ReadonlySet<string> = new Set(["staubli_rx90l"]);

/**
 * simple_message says the joint angles of a robot's URDF as they are. The RX90L of the library counts as V+ does and
 * stands on a CS7.
 */
export const speaksSimpleMessage = (robot: Robot): boolean =>
  robot.arm.joints.length === JOINTS && !OTHERWISE.has(robot.id);
