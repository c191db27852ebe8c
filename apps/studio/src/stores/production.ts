import type { Program } from "@twincell/core";
import { createStore } from "zustand/vanilla";

/** How a production of the connected robot is begun, and what was sent for it last. */
export interface ProductionChoice {
  readonly cycles: "once" | "several" | "forever";
  /** Of "several". */
  readonly count: number;
  /** Held before each step. */
  readonly isStepping: boolean;
  /** Ids of steps before which it is held. */
  readonly breakpoints: readonly string[];
  /** The program that runs or takes over next; null before the first. */
  readonly sent: Program | null;
}
export const productionStore = createStore<ProductionChoice>(() => ({
  cycles: "several",
  count: 3,
  isStepping: false,
  breakpoints: [],
  sent: null,
}));

/** Of how many cycles; null for until it is ended. */
export const cyclesOf = ({ cycles, count }: ProductionChoice): number | null =>
  cycles === "forever" ? null : cycles === "once" ? 1 : count;

/** The breakpoints with that step as one of them, or no longer. */
export const toggled = (breakpoints: readonly string[], id: string): readonly string[] =>
  breakpoints.includes(id) ? breakpoints.filter(each => each !== id) : [...breakpoints, id];
