/** A list has no blocks. */
const NONE = /(?!)/;
export const LINES = { motion: /^\s*MOVE\b/i, opens: NONE, parts: NONE, closes: NONE, keeps: /^\s*(?:POSES|ROBOT)\b/i };
