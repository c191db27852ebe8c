import type { Robot } from "@twincell/core";

/** What the figure of a place means. */
export interface SupportedRobot {
  /** The sign of the library's wrist that is not flipped. */
  readonly nonFlip: "positive" | "negative";
}
/**
 * Robots whose controllers speak PacScript. Joint angles are those of the library in degrees: the maker's own driver
 * sends those of its URDF.
 */
const SPOKEN: Readonly<Record<string, SupportedRobot>> = { denso_vs060: { nonFlip: "positive" } };

/** What is known of the robot's controller, or undefined for a robot whose controller does not speak PacScript. */
export const supportedBy = (robot: Robot): SupportedRobot | undefined =>
  Object.hasOwn(SPOKEN, robot.id) ? SPOKEN[robot.id] : undefined;

/** Numbers of lines: inputs and outputs are counted in one row. */
export const LINES = [0, 511] as const;
/** The output that closes the gripper, and its name. */
export const GRIPPER = { name: "doGripper", output: 128 } as const;
