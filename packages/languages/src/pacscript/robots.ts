/** Numbers of lines: inputs and outputs are counted in one row. */
export const LINES = [0, 511] as const;
/** The output that closes the gripper, and its name. */
export const GRIPPER = { name: "doGripper", output: 128 } as const;
