/** Clocks run apart slowly: the fastest way ever seen is forgotten after this long [s]. */
const WINDOW_S = 10;

export interface Metered {
  rate_Hz: number;
  late_s: number;
  missing: number;
}

/**
 * How steadily samples come. `late_s` maps the controller's clock to ours by the sample that came fastest in the last
 * 10 to 20 seconds: late = (received − sent) − min(received − sent). The constant part of the way cannot be seen from
 * one side; half a round trip tells it.
 */
export class Meter {
  readonly now: Metered = { rate_Hz: 0, late_s: 0, missing: 0 };
  private least_s = Infinity;
  private leastBefore_s = Infinity;
  private windowFrom_s = -Infinity;
  private sequence = NaN;
  private time_s = NaN;
  private second = NaN;
  private count = 0;

  /**
   * @param sequence    the controller's count of what it sent.
   * @param time_s      the controller's own time.
   * @param received_s  our time.
   * @returns whether it is newer than the one before; a datagram that was overtaken is not. A controller that booted
   *   counts from its beginning again.
   */
  take(sequence: number, time_s: number, received_s: number): boolean {
    const booted = time_s < this.time_s - BOOTED_S;
    if (booted) {
      this.least_s = this.leastBefore_s = Infinity;
      this.sequence = NaN;
    } else if (sequence <= this.sequence) return false;
    if (sequence > this.sequence + 1) this.now.missing += sequence - this.sequence - 1;
    this.sequence = sequence;
    this.time_s = time_s;
    if (received_s - this.windowFrom_s > WINDOW_S) {
      this.windowFrom_s = received_s;
      this.leastBefore_s = this.least_s;
      this.least_s = Infinity;
    }
    const way_s = received_s - time_s;
    this.least_s = Math.min(this.least_s, way_s);
    this.now.late_s = way_s - Math.min(this.least_s, this.leastBefore_s);
    const second = Math.floor(received_s);
    if (second !== this.second) {
      this.now.rate_Hz = second === this.second + 1 ? this.count : 0;
      this.second = second;
      this.count = 0;
    }
    this.count++;
    return true;
  }

  /** A connection begins: who counts what it sent may count from its beginning, on another clock. */
  begin(): void {
    this.least_s = this.leastBefore_s = Infinity;
    this.sequence = this.time_s = NaN;
    this.windowFrom_s = -Infinity;
  }
  /** For a link that was opened anew. */
  reset(): void {
    Object.assign(this.now, { rate_Hz: 0, late_s: 0, missing: 0 });
    this.begin();
    this.second = NaN;
    this.count = 0;
  }
}

/** A clock that goes back by more than this was started anew [s]. */
const BOOTED_S = 1;
