/** Numbers of lines: outputs, and inputs behind them. */
export const LINES = { outputs: [1, 960], inputs: [1001, 1960] } as const;
