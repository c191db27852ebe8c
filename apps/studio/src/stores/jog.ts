import { createStore } from "zustand/vanilla";

export type JogFrame = "joint" | "base" | "tool" | "user" | "world";
export interface DragLocks {
  readonly x: boolean;
  readonly y: boolean;
  readonly z: boolean;
  readonly turn: boolean;
}
export const NO_LOCKS: DragLocks = { x: false, y: false, z: false, turn: false };
export const SMALLEST_DRAG = 0.1;
export const LARGEST_DRAG = 2;
export interface JogState {
  readonly frame: JogFrame;
  /** Name of the frame that "user" means; "" when the cell has none. */
  readonly userFrame: string;
  /** "steps": one press is one step. "hold": moves while held. */
  readonly manner: "hold" | "steps";
  readonly step_m: number;
  readonly step_rad: number;
  /** Continuous jog: fraction of the manual-mode speed cap, 0 … 1. */
  readonly speed: number;
  /** The tool goes this share of the way of the hand that drags it, 0.1 … 2 (row L-28). */
  readonly dragScale: number;
  /** What a dragging hand may not change: the place along an axis of the handle, or the orientation (row L-30). */
  readonly locks: DragLocks;
  /** Index into the orientation aids, or null when the tool is free (N-52). */
  readonly aid: number | null;
  /** Why the last jog was refused, for the panel; null when free. */
  readonly blocked: { readonly sentence: string; readonly joint?: number; readonly until_ms: number } | null;
  /** Something is held down now. */
  readonly moving: boolean;
}
export const jogStore = createStore<JogState>(() => ({
  frame: "world",
  userFrame: "",
  manner: "hold",
  step_m: 0.005,
  step_rad: Math.PI / 180,
  speed: 0.5,
  dragScale: 1,
  locks: NO_LOCKS,
  aid: null,
  blocked: null,
  moving: false,
}));

export const chooseFrame = (frame: JogFrame): void => jogStore.setState({ frame });
export const JOG_STEPS_M = [0.0001, 0.001, 0.005, 0.01, 0.05] as const;
