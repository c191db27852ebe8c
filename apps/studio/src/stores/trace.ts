import type { Vector3 } from "@twincell/core";
import { createStore } from "zustand/vanilla";

export interface TraceOptions {
  /** Angle between the tool axis and the surface beside the edge [rad]. */
  readonly tilt_rad: number;
  readonly leadIn_m: number;
  readonly leadOut_m: number;
  readonly chordTolerance_m: number;
  /** How far the executed TCP path may leave the edge between taught points (N-58). */
  readonly pathTolerance_m: number;
  readonly motion: "joint" | "straight";
  readonly speed_mps: number;
}

/** What came of the last trace. */
export interface TraceResult {
  readonly points: number;
  readonly edges: number;
  readonly inserted: number;
  readonly deviation_m: number;
}
/** Edge tracing: which edges of which object are under the pointer and chosen. Polylines are in the world [m]. */
export interface TraceState {
  readonly active: boolean;
  readonly wholeLoop: boolean;
  readonly hovered: { readonly object: string; readonly polyline: readonly Vector3[] } | null;
  readonly chosen: readonly { readonly object: string; readonly edge: number; readonly polyline: readonly Vector3[] }[];
  readonly options: TraceOptions;
  readonly working: boolean;
  readonly last: TraceResult | null;
}
export const traceStore = createStore<TraceState>(() => ({
  active: false,
  wholeLoop: false,
  hovered: null,
  chosen: [],
  working: false,
  last: null,
  options: {
    tilt_rad: Math.PI / 4,
    leadIn_m: 0.03,
    leadOut_m: 0.03,
    chordTolerance_m: 0.0002,
    pathTolerance_m: 0.0005,
    motion: "joint",
    speed_mps: 0.1,
  },
}));
