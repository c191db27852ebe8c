import { createStore } from "zustand/vanilla";

/** The run under way, or the last one, beside what `controlStore` says of the controller. */
export interface RunState {
  readonly phase: "idle" | "running" | "ended";
  readonly held: boolean;
  readonly elapsed_s: number;
  readonly gripperClosed: boolean;
  /** How it ended, one sentence. */
  readonly ending: string;
  readonly good: boolean;
  /** Id of the recording. */
  readonly recording: string | null;
}
export const runStore = createStore<RunState>(() => ({ phase: "idle", held: false, elapsed_s: 0, gripperClosed: false, ending: "", good: true, recording: null }));
