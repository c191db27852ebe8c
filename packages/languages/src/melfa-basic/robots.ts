/** Numbers of inputs and of outputs. */
export const LINES = [0, 32767] as const;
