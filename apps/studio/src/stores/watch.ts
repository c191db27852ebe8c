import { createStore } from "zustand/vanilla";

/** What the live collision check sees of the robot on screen; written at most ten times a second, contacts at once. */
export interface WatchState {
  /** Pairs in contact, by link name, "tool" or object id. */
  readonly contacts: readonly (readonly [string, string])[];
  /** Objects the tool point touches. */
  readonly touched: readonly string[];
  /**
   * Metres to the nearest thing around the robot; Infinity when there is plenty of room, null before the first look.
   */
  readonly clearance_m: number | null;
  readonly nearest: readonly [string, string];
  /** Time of one look in the worker. */
  readonly took_ms: number;
}
export const watchStore = createStore<WatchState>(() => ({
  contacts: [],
  touched: [],
  clearance_m: null,
  nearest: ["", ""],
  took_ms: 0,
}));
