import { createStore } from "zustand/vanilla";

/** Playing with contact: chosen by a person, heard of at most ten times a second. */
export interface PhysicsState {
  /** Play carries the program out with contact. */
  readonly on: boolean;
  /**
   * "loading" fetches the engine and builds the cell; "held" is paused by a person; "stopped" by a zone or a sensor.
   */
  readonly status: "idle" | "loading" | "running" | "held" | "stopped" | "paused" | "done";
  /** What happened last, newest first. */
  readonly said: readonly string[];
  readonly t_s: number;
  readonly step: string;
  /** Ids of sensors that are tripped. */
  readonly tripped: readonly string[];
  /** What the results rest on. */
  readonly assumptions: readonly string[];
}
export const physicsStore = createStore<PhysicsState>(() => ({
  on: false,
  status: "idle",
  said: [],
  t_s: 0,
  step: "",
  tripped: [],
  assumptions: [],
}));

/** Whether the parts on screen are where physics has them. */
export const physicsShows = ({ on, status }: PhysicsState): boolean => on && status !== "idle" && status !== "loading";
