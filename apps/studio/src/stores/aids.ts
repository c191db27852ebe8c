import { ORIENTATION_PRESET_COUNT } from "@twincell/core";
import { createStore } from "zustand/vanilla";

/** How many orientation aids the cell has (rows N-31, N-35, N-52). */
export const orientationPresetStore = createStore<{ readonly count: number }>(() => ({
  count: ORIENTATION_PRESET_COUNT,
}));
