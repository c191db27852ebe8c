import { createStore } from "zustand/vanilla";

/** A taught point that is being taught again while EDIT is held. */
export interface EditedPoint {
  readonly step: string;
  readonly name: string;
  /** How far the tool is from the point that cannot be reached, when it snapped to it [m]; 0 where it is there. */
  readonly short_m: number;
}
export interface EditState {
  readonly edited: EditedPoint | null;
}
export const editStore = createStore<EditState>(() => ({ edited: null }));
