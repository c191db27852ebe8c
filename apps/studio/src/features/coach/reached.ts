import type { StudioMode } from "../../stores/view.ts";

/** What was done so far, as the stores tell it. */
export interface Done {
  readonly tracing: boolean;
  readonly chosen: number;
  readonly steps: number;
  readonly mode: StudioMode;
  readonly judged: boolean;
  readonly runs: number;
}

/** The step of the coach that comes next, counted from 0; as many as there are steps when all is done. */
export function reachedStep({ tracing, chosen, steps, mode, judged, runs }: Done): number {
  if (runs > 0 && mode === "run") return 6;
  if (judged && mode === "check" && steps > 0) return 5;
  if (steps > 0 && mode === "teach") return 4;
  return chosen > 0 ? 3 : tracing ? 2 : 0;
}
