/** The output that closes the gripper while it is on. Its name must exist in the configuration of the controller. */
export const GRIPPER_SIGNAL = "doGripper";
