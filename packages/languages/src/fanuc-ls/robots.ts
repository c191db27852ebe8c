/** The output of the hand that closes the gripper while it is on. */
export const GRIPPER_OUTPUT = "RO[1]";
