import type { Robot } from "@twincell/core";

/** What the flags of a position mean. */
export interface SupportedRobot {
  /** The sign of the library's wrist that is not flipped. */
  readonly nonFlip: "positive" | "negative";
}
/**
 * Robots whose controllers speak MELFA-BASIC. Joint angles are those of the library in degrees: its zeros are the
 * maker's.
 */
const SPOKEN: Readonly<Record<string, SupportedRobot>> = { mitsubishi_rv7fl: { nonFlip: "positive" } };

/** What is known of the robot's controller, or undefined for a robot whose controller does not speak MELFA-BASIC. */
export const supportedBy = (robot: Robot): SupportedRobot | undefined =>
  Object.hasOwn(SPOKEN, robot.id) ? SPOKEN[robot.id] : undefined;

/** Numbers of inputs and of outputs. */
export const LINES = [0, 32767] as const;
