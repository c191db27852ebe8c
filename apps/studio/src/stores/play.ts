import type { CarriedPart, PathPiece, Plan, StepVerdict, Verdict } from "@twincell/core";
import { createStore } from "zustand/vanilla";

/** The program laid out in time, judged, and where on the timeline we look. */
export interface PlayState {
  readonly plan: Plan | null;
  readonly verdict: Verdict | null;
  /** Progress 0 … 1 of the check under way; null when none is. */
  readonly checking: number | null;
  /** The cell changed since the verdict, and its check is not done yet. */
  readonly stale: boolean;
  /** The check itself could not be done: why. */
  readonly trouble: string | null;
  /**
   * Seconds; written at most ten times a second while playing (the frame loop keeps the exact time in
   * `live/playhead.ts`).
   */
  readonly t_s: number;
  readonly playing: boolean;
  /** 0 … 1. 0 holds. */
  readonly speed: number;
  /** TCP path in the world, cut where its verdict changes, for drawing. */
  readonly path: readonly PathPiece[];
  /** Parts that the program takes, and where it leaves them; played without physics as well (row L-34). */
  readonly carried: readonly CarriedPart[];
  /** The other robots of the cell count as obstacles, where they stand when it is checked. */
  readonly withOthers: boolean;
  /** A repair being shown and not yet applied: the ids of the steps it would change. */
  readonly preview: string | null;
}
export const playStore = createStore<PlayState>(() => ({
  plan: null,
  verdict: null,
  checking: null,
  stale: false,
  trouble: null,
  t_s: 0,
  playing: false,
  speed: 1,
  path: [],
  carried: [],
  withOthers: false,
  preview: null,
}));

/** Worst first wins: bad, warn, unknown, ok. */
const RANK: Readonly<Record<StepVerdict, number>> = { ok: 0, unknown: 1, warn: 2, bad: 3 };
export const worse = (a: StepVerdict, b: StepVerdict): StepVerdict => (RANK[b] > RANK[a] ? b : a);
export function verdictOf(verdict: Verdict | null, id: string): StepVerdict {
  return verdict?.steps.find(step => step.id === id)?.verdict ?? "unknown";
}
