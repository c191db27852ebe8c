import { createStore } from "zustand/vanilla";

/** The one connection of the robot of the cell: the simulated controller, or a vendor's, virtual or real. */
export interface ConnectionState {
  /** The connected controller; null: the simulated one of the page. */
  readonly station: string | null;
  /**
   * "live": the robot on screen is the twin of the connected one. "clone": it is moved and taught, and the twin stays
   * where the robot is.
   */
  readonly view: "live" | "clone";
  /** The enabling switch of the pendant is held. */
  readonly enabled: boolean;
}
export const connectionStore = createStore<ConnectionState>(() => ({ station: null, view: "live", enabled: false }));

/** Whether the robot on screen is the twin of a connected one, and nothing but that one moves it. */
export const isLive = (): boolean => {
  const { station, view } = connectionStore.getState();
  return station !== null && view === "live";
};
export const isClone = ({ station, view }: ConnectionState): boolean => station !== null && view === "clone";
