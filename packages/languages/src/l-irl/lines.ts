import type { LineShapes } from "@twincell/core";

/** A list has no blocks. */
const NONE = /(?!)/;

export const LINES: LineShapes = {
  motion: /^\s*MOVE\b/i,
  opens: NONE,
  parts: NONE,
  closes: NONE,
  keeps: /^\s*(?:POSES|ROBOT)\b/i,
};
