import type { Notes } from "./notes.ts";

/** Gathers how late things are and says it once a second, as a recording keeps it (rows T-61, X-48). */
export interface LatencyMeter {
  /** One measured delay [ms]. Allocates nothing. */
  add(late_ms: number): void;
  /** What was gathered since the last one that was due; null before a second is over, or when nothing came. */
  due(now_s: number): Notes["latency"] | null;
}

const EVERY_S = 1;
/** Beyond this many in a second the later ones are counted, not sorted. */
const MOST = 2000;

export function latencyMeter(stage: string, direction: Notes["latency"]["direction"]): LatencyMeter {
  const late = new Float64Array(MOST);
  let samples = 0;
  let worst_ms = 0;
  let from_s = NaN;
  return {
    add(late_ms) {
      if (samples < MOST) late[samples] = late_ms;
      samples++;
      worst_ms = Math.max(worst_ms, late_ms);
    },
    due(now_s) {
      if (Number.isNaN(from_s)) from_s = now_s;
      if (now_s - from_s < EVERY_S) return null;
      from_s = now_s;
      if (samples === 0) return null;
      const sorted = late.subarray(0, Math.min(samples, MOST)).sort();
      const at = (part: number): number =>
        rounded(sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))]!);
      const said = { stage, direction, samples, median_ms: at(0.5), p99_ms: at(0.99), worst_ms: rounded(worst_ms) };
      samples = worst_ms = 0;
      return said;
    },
  };
}
const rounded = (ms: number): number => Number(ms.toFixed(3));
