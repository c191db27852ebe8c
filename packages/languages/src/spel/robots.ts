import type { Robot } from "@twincell/core";

/** What the words for the postures of a robot mean. */
export interface SupportedRobot {
  /** The sign of the library's wrist that is called NoFlip. */
  readonly noFlip: "positive" | "negative";
}
/**
 * Robots whose controllers speak SPEL+. Joint angles are those of the library in degrees: its zeros are the maker's.
 */
const SPOKEN: Readonly<Record<string, SupportedRobot>> = { epson_c4_a601s: { noFlip: "positive" } };

/** What is known of the robot's controller, or undefined for a robot whose controller does not speak SPEL+. */
export const supportedBy = (robot: Robot): SupportedRobot | undefined =>
  Object.hasOwn(SPOKEN, robot.id) ? SPOKEN[robot.id] : undefined;

/** Numbers of inputs and of outputs. */
export const LINES = [0, 511] as const;
/** The output that closes the gripper, and its name. */
export const GRIPPER = { name: "doGripper", output: 15 } as const;
