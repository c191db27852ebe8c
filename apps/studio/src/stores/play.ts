import type { Plan, Vector3, Verdict } from "@twincell/core";
import { createStore } from "zustand/vanilla";

/** The program laid out in time, judged, and where on the timeline we look. */
export interface PlayState {
  readonly plan: Plan | null;
  readonly verdict: Verdict | null;
  /** Progress 0 … 1 of the check under way; null when none is. */
  readonly checking: number | null;
  /** Seconds; written at most ten times a second while playing (the frame loop keeps the exact time in `live/playhead.ts`). */
  readonly t_s: number;
  readonly playing: boolean;
  /** 0 … 1. 0 holds. */
  readonly speed: number;
  /** TCP path in the world with the verdict of each stretch, for drawing. */
  readonly path: readonly { readonly step: string; readonly verdict: "ok" | "warn" | "bad" | "unknown"; readonly points: readonly Vector3[] }[];
}
export const playStore = createStore<PlayState>(() => ({ plan: null, verdict: null, checking: null, t_s: 0, playing: false, speed: 1, path: [] }));
