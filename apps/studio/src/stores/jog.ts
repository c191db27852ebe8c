import { createStore } from "zustand/vanilla";

export type JogFrame = "joint" | "base" | "tool" | "user" | "world";
export interface JogState {
  readonly frame: JogFrame;
  readonly step_m: number;
  readonly step_rad: number;
  /** Continuous jog: fraction of the manual-mode speed cap, 0 … 1. */
  readonly speed: number;
  /** Index into the orientation aids, or null when the tool is free (N-52). */
  readonly aid: number | null;
  /** Why the last jog was refused, for the panel; null when free. */
  readonly blocked: { readonly sentence: string; readonly joint?: number; readonly until_ms: number } | null;
}
export const jogStore = createStore<JogState>(() => ({ frame: "world", step_m: 0.005, step_rad: Math.PI / 180, speed: 0.5, aid: null, blocked: null }));
