import { createStore } from "zustand/vanilla";

export interface RecordState {
  /** The way of the hand is recorded as it moves the robot (row N-57). */
  readonly moving: boolean;
}
export const recordStore = createStore<RecordState>(() => ({ moving: false }));

/** A point is recorded when the tool went this far from the last one, or it or a joint turned this far. */
export const RECORD_EVERY_M = 0.001;
export const RECORD_EVERY_RAD = Math.PI / 180;

export const recordMoving = (moving: boolean): void => recordStore.setState({ moving });
