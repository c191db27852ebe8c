import { createStore } from "zustand/vanilla";

export type JogFrame = "joint" | "base" | "tool" | "user" | "world";
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
  aid: null,
  blocked: null,
  moving: false,
}));

export const chooseFrame = (frame: JogFrame): void => jogStore.setState({ frame });
export const JOG_STEPS_M = [0.0001, 0.001, 0.005, 0.01, 0.05] as const;
