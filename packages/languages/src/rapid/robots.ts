import type { Robot } from "@twincell/core";

/**
 * How RAPID names the posture of a robot: `cfx` for an arm with a spherical wrist, or quarters of three axes alone
 * where nobody has said what cfx means. Joint angles are those of the library in degrees, the base is the root link.
 */
export interface Configuration {
  readonly hasCfx: boolean;
}

const ROBOTS: Readonly<Record<string, Configuration>> = {
  abb_irb120: { hasCfx: true },
  abb_crb15000_5_95: { hasCfx: false },
};

/** Undefined for a robot whose controller does not speak RAPID. */
export const configurationOf = (robot: Robot): Configuration | undefined => ROBOTS[robot.id];

/** The output that closes the gripper while it is on. Its name must exist in the configuration of the controller. */
export const GRIPPER_SIGNAL = "doGripper";
