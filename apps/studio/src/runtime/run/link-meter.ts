const KEPT = 8192;

/**
 * How old the controller's samples were when the robot on screen stood as they say, and how many never came. Written in
 * place.
 */
export class LinkMeter {
  readonly #ages_ms = new Float64Array(KEPT);
  #last = 0;
  samples = 0;
  lost = 0;

  /** @param sequence  counts up by one from sample to sample. */
  add(sequence: number, age_ms: number): void {
    if (this.samples > 0) this.lost += Math.max(0, sequence - this.#last - 1);
    this.#last = sequence;
    this.#ages_ms[this.samples++ % KEPT] = Math.max(0, age_ms);
  }
  reset(): void {
    this.samples = this.lost = 0;
  }
  /** The latest 8192 ages [ms]. */
  get ages_ms(): number[] {
    return Array.from(this.#ages_ms.subarray(0, Math.min(this.samples, KEPT)));
  }
}

/** Of the run under way, or of the last one. */
export const linkMeter = new LinkMeter();
