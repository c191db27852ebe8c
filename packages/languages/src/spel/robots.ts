/** Numbers of inputs and of outputs. */
export const LINES = [0, 511] as const;
/** The output that closes the gripper, and its name. */
export const GRIPPER = { name: "doGripper", output: 15 } as const;
