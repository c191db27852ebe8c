import { createStore } from "zustand/vanilla";

/** A recorded run, kept in the browser. */
export interface RunRecord {
  readonly id: string;
  readonly name: string;
  readonly startedAt: string;
  readonly duration_s: number;
  readonly bytes: number;
  readonly ending: "done" | "stopped" | "refused";
}
export interface HistoryState {
  readonly runs: readonly RunRecord[];
  readonly open: string | null;
  readonly t_s: number;
  readonly playing: boolean;
}
export const historyStore = createStore<HistoryState>(() => ({ runs: [], open: null, t_s: 0, playing: false }));
