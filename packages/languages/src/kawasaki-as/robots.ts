import type { Robot } from "@twincell/core";

/** How the words of AS name the postures of a robot. */
export interface SupportedRobot {
  /** The sign of the library's wrist that is a JT5 above 0. */
  readonly upWrist: "positive" | "negative";
}

/**
 * Robots whose controllers speak AS. Joint angles are those of the library in degrees: the maker's own driver sends the
 * values of its URDF to the controller as they are.
 */
const SPOKEN: Readonly<Record<string, SupportedRobot>> = {
  kawasaki_rs007l: { upWrist: "negative" },
};

/** What is known of the robot's controller, or undefined for a robot whose controller does not speak AS. */
export const supportedBy = (robot: Robot): SupportedRobot | undefined =>
  Object.hasOwn(SPOKEN, robot.id) ? SPOKEN[robot.id] : undefined;

/** Numbers of lines: outputs, and inputs behind them. */
export const LINES = { outputs: [1, 960], inputs: [1001, 1960] } as const;
