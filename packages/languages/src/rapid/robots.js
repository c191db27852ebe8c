const ROBOTS = {
    abb_irb120: { hasCfx: true },
    abb_crb15000_5_95: { hasCfx: false },
};
/** Undefined for a robot whose controller does not speak RAPID. */
export const configurationOf = (robot) => ROBOTS[robot.id];
/** The output that closes the gripper while it is on. Its name must exist in the configuration of the controller. */
export const GRIPPER_SIGNAL = "doGripper";
