import type { Reach } from "../kinematics/reach.ts";

/**
 * A coordinate that did not go on: an axis of the jog frame, all rotation together (row N-41), or a joint counted from
 * 1.
 */
export interface JogBlock {
  readonly coordinate: "x" | "y" | "z" | "rotation" | number;
  readonly reach: Reach;
  readonly sentence: string;
}

/**
 * fraction: how much of the wanted step was taken; below 1 the joints would have been too fast, or the reach ends
 * there.
 */
export type Jogged =
  | { readonly kind: "moved"; readonly fraction: number; readonly blocked: readonly JogBlock[] }
  | { readonly kind: "blocked"; readonly blocked: readonly JogBlock[] };
