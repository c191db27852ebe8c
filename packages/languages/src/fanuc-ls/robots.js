const ROBOTS = {
    fanuc_lrmate200id: { coupling: 1 },
};
/** Undefined for a robot whose controller does not speak TP. */
export const pendantConvention = (robot) => ROBOTS[robot.id];
/** The output of the hand that closes the gripper while it is on. */
export const GRIPPER_OUTPUT = "RO[1]";
