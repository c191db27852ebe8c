import { createStore } from "zustand/vanilla";

/** How many orientation aids the cell has (rows N-31, N-35, N-52). */
export const aidStore = createStore<{ readonly count: number }>(() => ({ count: 4 }));
