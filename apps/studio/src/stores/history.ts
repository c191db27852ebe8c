import type { Comparison, Cycle, Dashboard, Mark } from "@twincell/recording";
import type { OperatingMode, Pose, SafetyState, Vector3 } from "@twincell/core";
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

/** How everything stood at the moment that is looked at. */
export interface MomentWords {
  readonly step: string;
  readonly mode: OperatingMode;
  readonly safety: SafetyState;
  readonly gripperClosed: boolean;
  readonly message: string;
  readonly signals: Readonly<Record<string, boolean | number>>;
  /** False in a gap: nothing was recorded then. */
  readonly recorded: boolean;
}
const NOTHING: MomentWords = {
  step: "",
  mode: "automatic",
  safety: "normal",
  gripperClosed: false,
  message: "",
  signals: {},
  recorded: true,
};

/** Two cycles laid over each other: the ways of the tool in the world, and how they differ. */
export interface Overlay {
  readonly first: number;
  readonly second: number;
  readonly ways: readonly (readonly Vector3[])[];
  readonly comparison: Comparison | null;
}

export interface HistoryState {
  readonly runs: readonly RunRecord[];
  /** Id of the run being looked at; null when it is a file that was opened, or none. */
  readonly open: string | null;
  /** Name of what is open, or "". */
  readonly name: string;
  /** Wall clock at its start, milliseconds since 1970. */
  readonly startedAt_ms: number;
  readonly opening: boolean;
  readonly duration_s: number;
  /** Written at most ten times a second while playing. */
  readonly t_s: number;
  readonly playing: boolean;
  readonly speed: number;
  readonly marks: readonly Mark[];
  readonly cycles: readonly Cycle[];
  /** What of it could not be read, in words. */
  readonly troubles: readonly string[];
  /** The part of the time that the timeline shows. */
  readonly window: { readonly from_s: number; readonly to_s: number };
  readonly moment: MomentWords;
  readonly figures: Dashboard | null;
  readonly overlay: Overlay | null;
  /** Where the recorded robot stands when it is another than that of the cell. */
  readonly past: Pose<"world", "base"> | null;
}
const CLOSED = {
  open: null,
  name: "",
  startedAt_ms: 0,
  opening: false,
  duration_s: 0,
  t_s: 0,
  playing: false,
  speed: 1,
  marks: [],
  cycles: [],
  troubles: [],
  window: { from_s: 0, to_s: 0 },
  moment: NOTHING,
  figures: null,
  overlay: null,
  past: null,
} satisfies Omit<HistoryState, "runs">;
export const historyStore = createStore<HistoryState>(() => ({ runs: [], ...CLOSED }));
export const closeHistory = (): void => historyStore.setState(CLOSED);

/** The timeline shows so much time about the moment that is looked at; null is all of it. */
export function zoomTo(length_s: number | null): void {
  const { duration_s, t_s } = historyStore.getState();
  if (length_s === null || length_s >= duration_s) {
    historyStore.setState({ window: { from_s: 0, to_s: duration_s } });
    return;
  }
  const from_s = Math.min(Math.max(0, t_s - length_s / 2), duration_s - length_s);
  historyStore.setState({ window: { from_s, to_s: from_s + length_s } });
}
/** A moment that left the window takes it along. */
export function windowAt(
  t_s: number,
  { window: { from_s, to_s }, duration_s }: Pick<HistoryState, "window" | "duration_s">,
): HistoryState["window"] {
  const length_s = to_s - from_s;
  if (t_s >= from_s && t_s <= to_s) return { from_s, to_s };
  const begin_s = Math.min(Math.max(0, t_s - length_s / 2), Math.max(0, duration_s - length_s));
  return { from_s: begin_s, to_s: begin_s + length_s };
}
