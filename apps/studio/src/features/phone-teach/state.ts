import { createStore } from "zustand/vanilla";

/** Whether the pad turns the tool instead of moving it. */
export const phoneTeachStore = createStore<{ readonly turn: boolean }>(() => ({ turn: false }));
