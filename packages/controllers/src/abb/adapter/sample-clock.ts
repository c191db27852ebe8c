/**
 * Counts and times of samples that come from two sources in turn: EGM counts and dates its own, states that were asked
 * for are counted and dated here.
 */
export class SampleClock {
  sequence = 0;
  time_s = 0;
  private readonly now_s: () => number;
  private last = 0;
  private lastTime_s = -Infinity;
  private base = 0;
  private offset_s = 0;
  private last_ms = NaN;
  private isTheirs = false;

  constructor(now_s: () => number) {
    this.now_s = now_s;
  }

  /**
   * One of EGM. A controller that booted, or that was silent, goes on where the others ended; what was overtaken on its
   * way still counts as older.
   */
  theirs(sequence: number, time_ms: number): void {
    if (!this.isTheirs || time_ms < this.last_ms - BOOTED_MS) {
      this.base = this.last + 1 - sequence;
      this.offset_s = Math.max(this.now_s(), this.lastTime_s + LEAST_S) - time_ms / 1000;
    }
    this.isTheirs = true;
    this.last_ms = time_ms;
    this.set(this.base + sequence, this.offset_s + time_ms / 1000);
  }
  ours(): void {
    this.isTheirs = false;
    this.set(this.last + 1, Math.max(this.now_s(), this.lastTime_s + LEAST_S));
  }
  private set(sequence: number, time_s: number): void {
    this.sequence = sequence;
    this.time_s = time_s;
    if (sequence <= this.last) return;
    this.last = sequence;
    this.lastTime_s = time_s;
  }
}
const BOOTED_MS = 1000;
const LEAST_S = 1e-4;
