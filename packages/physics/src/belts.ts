import type { PhysicalScene, Signals } from "@twincell/core";

/** A belt comes to its speed with this acceleration, so that what stands on it does not fall over [m/s²]. */
const START_MPS2 = 1;

/** Belts move what lies on them: each stands still and has a speed, which contacts feel. */
export class Belts {
  private readonly belts: readonly {
    readonly speed_mps: number;
    readonly runs: { readonly signal: string; readonly is: boolean } | undefined;
  }[];
  private readonly speeds: Float64Array;
  private readonly signals: Signals;
  constructor({ objects }: PhysicalScene, signals: Signals) {
    this.belts = objects.flatMap(({ belt, role }) =>
      belt === undefined || role !== "fixture" ? [] : [{ speed_mps: belt.speed_mps, runs: belt.runs }],
    );
    this.speeds = new Float64Array(this.belts.length);
    this.signals = signals;
  }

  /** @param first  where the coordinates of belts begin. */
  drive(qpos: Float64Array, qvel: Float64Array, first: number, step_s: number): void {
    for (let i = 0; i < this.belts.length; i++) {
      const { speed_mps, runs } = this.belts[i]!;
      const on =
        runs === undefined ||
        (this.signals.read(runs.signal) !== false && this.signals.read(runs.signal) !== 0) === runs.is;
      const wanted = on ? speed_mps : 0;
      const now = this.speeds[i]!;
      const most = START_MPS2 * step_s;
      this.speeds[i] = now + Math.max(-most, Math.min(most, wanted - now));
      qpos[first + i] = 0;
      qvel[first + i] = this.speeds[i]!;
    }
  }

  reset(): void {
    this.speeds.fill(0);
  }
}
