import type { Pose, SignalLine } from "@twincell/core";

/**
 * What a program tells of its cell while it is executed: tools, frames and lines, by name. The machine that executes it
 * adds what it meets.
 */
export interface DeclaredCell {
  readonly tools: Record<string, Pose<"flange", "tcp">>;
  readonly frames: Record<string, Pose<"world", "frame">>;
  readonly signals: Record<string, SignalLine>;
}
export const createDeclaredCell = (): DeclaredCell => ({ tools: {}, frames: {}, signals: {} });
