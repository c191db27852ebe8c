import { AID_COUNT } from "@twincell/core";
import { createStore } from "zustand/vanilla";

/** How many orientation aids the cell has (rows N-31, N-35, N-52). */
export const aidStore = createStore<{ readonly count: number }>(() => ({ count: AID_COUNT }));
