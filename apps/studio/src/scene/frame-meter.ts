const SIZE = 1024;

/**
 * How long our own script takes in a frame, and apart from it how long the renderer's draw calls take
 * (software rasterising would hide everything else). A ring of the last 1024 frames, written in place.
 */
export class FrameMeter {
  readonly script_ms = new Float64Array(SIZE);
  readonly draw_ms = new Float64Array(SIZE);
  /** Frames drawn since the start. */
  frames = 0;
  #script = 0;
  #draw = 0;

  /**
   * Script time spent on behalf of the frame under way: frame callbacks, pointer events, the heartbeat, the
   * controller's cycle.
   */
  addScript(ms: number): void {
    this.#script += ms;
  }
  addDraw(ms: number): void {
    this.#draw += ms;
  }

  endFrame(): void {
    const at = this.frames % SIZE;
    this.script_ms[at] = this.#script;
    this.draw_ms[at] = this.#draw;
    this.#script = this.#draw = 0;
    this.frames++;
  }

  reset(): void {
    this.frames = 0;
    this.#script = this.#draw = 0;
  }

  /** Quantiles over the frames kept [ms]. */
  summary(): { readonly frames: number; readonly script: Quantiles; readonly draw: Quantiles } {
    const n = Math.min(this.frames, SIZE);
    return {
      frames: this.frames,
      script: quantiles(this.script_ms.slice(0, n)),
      draw: quantiles(this.draw_ms.slice(0, n)),
    };
  }
}

export interface Quantiles {
  readonly median: number;
  readonly p95: number;
  readonly worst: number;
}

function quantiles(values: Float64Array): Quantiles {
  values.sort();
  const at = (share: number): number => values[Math.min(values.length - 1, Math.floor(share * values.length))] ?? 0;
  return { median: at(0.5), p95: at(0.95), worst: at(1) };
}
