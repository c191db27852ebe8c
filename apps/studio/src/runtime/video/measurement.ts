import { COUNTS, SESSIONS, type TimeCode } from "./time-code.ts";

/**
 * A code stays so long: a camera that looks for 1/30 s at a time then sees two of them at once in one picture of three
 * [s].
 */
export const HOLD_S = 0.1;
/** A picture that shows a code from before so many others is not counted: nobody steers by it. */
const REMEMBERED = 128;

export interface LatencyFigures {
  readonly n: number;
  readonly median_s: number;
  readonly p95_s: number;
  readonly least_s: number;
  readonly most_s: number;
}

/**
 * Glass to glass on one clock: the page draws a code and remembers when; a camera films it; the first picture that
 * comes back with that code, once it is drawn, says how long everything together took. That the code was drawn before
 * it shone counts in full, that the picture was drawn before it shone does not: both take the same, so that the sum is
 * right. Counted is from a change in front of the camera to the first picture that shows it: half a picture's period is
 * in it.
 */
export interface Measurement {
  readonly session: number;
  /** The code for this moment; the same until its time is over. */
  codeAt(now_s: number): TimeCode;
  /**
   * A picture, drawn at `drawn_s`, shows these codes, of which the newest counts. Returns its latency if it is the
   * first to show it.
   */
  seen(codes: readonly TimeCode[], drawn_s: number): number | null;
  readonly figures: LatencyFigures | null;
}

/** @param random  0 … 1, once */
export function createMeasurement(random: number): Measurement {
  const session = Math.floor(random * SESSIONS) % SESSIONS;
  const drawn = new Float64Array(REMEMBERED);
  const latencies: number[] = [];
  let counter = 0;
  let begun_s = -Infinity;
  let last = 0;
  return {
    session,
    codeAt(now_s) {
      if (now_s - begun_s >= HOLD_S) {
        counter++;
        begun_s = now_s;
        drawn[counter % REMEMBERED] = now_s;
      }
      return { counter: counter % COUNTS, session };
    },
    seen(codes, drawn_s) {
      let whole = 0;
      // Back from 16 bits to all of them: the nearest that is not ahead.
      for (const code of codes)
        if (code.session === session)
          whole = Math.max(whole, counter - ((((counter - code.counter) % COUNTS) + COUNTS) % COUNTS));
      if (whole <= last || counter - whole >= REMEMBERED) return null;
      last = whole;
      const latency_s = drawn_s - drawn[whole % REMEMBERED]!;
      latencies.push(latency_s);
      return latency_s;
    },
    get figures() {
      return figuresOf(latencies);
    },
  };
}

/** Null before the first. The 95th percentile is the least value that 95 % are not above. */
export function figuresOf(latencies_s: readonly number[]): LatencyFigures | null {
  const sorted = latencies_s.toSorted((a, b) => a - b);
  const n = sorted.length;
  if (n === 0) return null;
  const at = (part: number): number => sorted[Math.max(0, Math.ceil(part * n) - 1)]!;
  return { n, median_s: at(0.5), p95_s: at(0.95), least_s: sorted[0]!, most_s: sorted[n - 1]! };
}
