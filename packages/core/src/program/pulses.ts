import type { Signals } from "../signals.ts";
import type { SetStep } from "./program.ts";

/** Outputs that go back by themselves, while the program goes on. */
export class Pulses {
  private readonly signals: Signals;
  private readonly running: { readonly signal: string; readonly back: boolean; left_s: number }[] = [];
  constructor(signals: Signals) {
    this.signals = signals;
  }

  get pending(): boolean {
    return this.running.length > 0;
  }

  /** Writes the output; a pulse of the same line that is still running is over with it. */
  set({ signal, to, pulse_s }: SetStep): void {
    const at = this.running.findIndex(pulse => pulse.signal === signal);
    if (at >= 0) this.running.splice(at, 1);
    this.signals.write(signal, to);
    if (pulse_s !== undefined && typeof to === "boolean") this.running.push({ signal, back: !to, left_s: pulse_s });
  }

  advance(dt_s: number): void {
    for (let i = this.running.length - 1; i >= 0; i--) {
      const pulse = this.running[i]!;
      pulse.left_s -= dt_s;
      if (pulse.left_s > 1e-9) continue;
      this.signals.write(pulse.signal, pulse.back);
      this.running.splice(i, 1);
    }
  }
}
