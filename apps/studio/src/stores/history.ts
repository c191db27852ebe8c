import type { Pose } from "@twincell/core";
import { createStore } from "zustand/vanilla";

export type RunEnding = "done" | "stopped" | "refused" | "running" | "cut-off";

/** A recorded run, kept in the browser. */
export interface RunRecord {
  readonly id: string;
  readonly name: string;
  /** ISO 8601. */
  readonly startedAt: string;
  readonly duration_s: number;
  readonly bytes: number;
  /** "cut-off": the page was closed while it ran; everything but the last second is there. */
  readonly ending: RunEnding;
  /** Of another controller than the cell's own: its robot, and where that stood. */
  readonly station?: { readonly robot: string; readonly stand: Pose<"world", "base"> };
}

export interface RunEventLine { readonly at_s: number; readonly level: "info" | "warning" | "error"; readonly sentence: string }

export interface HistoryState {
  readonly runs: readonly RunRecord[];
  /** Id of the run being looked at. */
  readonly open: string | null;
  readonly opening: boolean;
  readonly duration_s: number;
  /** Written at most ten times a second while playing. */
  readonly t_s: number;
  readonly playing: boolean;
  readonly speed: number;
  readonly events: readonly RunEventLine[];
  /** Step that was being executed at `t_s`. */
  readonly step: string;
}
export const historyStore = createStore<HistoryState>(() => ({
  runs: [], open: null, opening: false, duration_s: 0, t_s: 0, playing: false, speed: 1, events: [], step: "",
}));
