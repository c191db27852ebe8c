import { createStore } from "zustand/vanilla";

/** Whether the page opens without a network, and whether a newer version waits. */
export interface OfflineState {
  /** "kept": everything is kept on this device. "unsupported": this page may keep nothing, see `why`. */
  readonly state: "asking" | "keeping" | "kept" | "unsupported";
  readonly why: string;
  /** Takes the waiting version; null while there is none. */
  readonly update: (() => void) | null;
}
export const offlineStore = createStore<OfflineState>(() => ({ state: "asking", why: "", update: null }));
