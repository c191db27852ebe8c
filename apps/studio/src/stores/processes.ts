import type { TraceOptions } from "./trace.ts";

/**
 * Row N-61: what a trace begins with, process by process. These are starting points from common practice, not the data
 * of any material, wire, nozzle or tool: whoever owns the process knows better, and every value can be changed
 * afterwards.
 */
export const PROCESS_NAMES = [
  "arc-welding",
  "deburring",
  "soldering",
  "chamfering",
  "gluing",
  "water-jet",
  "inspection",
] as const;
export type ProcessName = (typeof PROCESS_NAMES)[number];

/** Tilt [°], speed [mm/s], lead-in and lead-out, chord and path tolerance [mm]. */
const preset = (
  tilt_deg: number,
  speed_mm_s: number,
  lead_mm: readonly [number, number],
  chord_mm: number,
  path_mm: number,
  motion: TraceOptions["motion"],
): TraceOptions => ({
  tilt_rad: (tilt_deg * Math.PI) / 180,
  speed_mps: speed_mm_s / 1000,
  leadIn_m: lead_mm[0] / 1000,
  leadOut_m: lead_mm[1] / 1000,
  chordTolerance_m: chord_mm / 1000,
  pathTolerance_m: path_mm / 1000,
  motion,
});

export const PROCESSES: Readonly<Record<ProcessName, TraceOptions>> = {
  // The torch halves the angle of the joint; the seam is slow and straight.
  "arc-welding": preset(45, 8, [20, 20], 0.2, 0.5, "straight"),
  deburring: preset(45, 40, [15, 15], 0.1, 0.2, "joint"),
  soldering: preset(60, 5, [10, 15], 0.1, 0.2, "straight"),
  chamfering: preset(45, 20, [15, 15], 0.05, 0.1, "straight"),
  // The nozzle stands steep and the bead wants an even speed.
  gluing: preset(70, 100, [10, 20], 0.2, 0.5, "straight"),
  // Pierced beside the part, so with room before and after.
  "water-jet": preset(90, 50, [20, 20], 0.1, 0.2, "straight"),
  inspection: preset(60, 100, [30, 30], 0.5, 1, "joint"),
};

/** The process whose values these are; null when one was changed. */
export const processOf = (options: TraceOptions): ProcessName | null =>
  PROCESS_NAMES.find(name => JSON.stringify(PROCESSES[name]) === JSON.stringify({ ...PROCESSES[name], ...options })) ??
  null;
