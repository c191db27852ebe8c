import { GraspFilter, graspSignal, type GraspSignal, type PhysicalScene } from "@twincell/core";
import { TOUCH_SIZE } from "./model/scene.ts";

/** Longer than a knock between stiff bodies [s]. */
const PRESSED_S = 0.01;

/** Watches which parts the fingers touch and hold. */
export class Grasps {
  readonly signals: GraspSignal[];
  /** Force of each finger on each part, as felt last [N]. */
  readonly forces_N: Float64Array;
  private readonly pressed_s: Float64Array;
  private readonly filters: readonly GraspFilter[];
  private readonly hand: boolean;
  constructor({ gripper }: PhysicalScene, parts: number) {
    this.hand = gripper !== undefined;
    this.filters = Array.from({ length: parts }, () => new GraspFilter());
    this.signals = Array.from({ length: parts }, () => "free");
    this.forces_N = new Float64Array(2 * parts);
    this.pressed_s = new Float64Array(2 * parts);
  }

  /** @returns whether what is held changed. */
  sense(sensordata: Float64Array, closed: boolean, dt_s: number): boolean {
    if (!this.hand) return false;
    const parts = this.signals.length;
    let changed = false;
    for (let i = 0; i < parts; i++) {
      let touching = 0;
      for (let finger = 0; finger < 2; finger++) {
        const at = TOUCH_SIZE * (finger * parts + i);
        const found = sensordata[at]! > 0;
        if (found) touching++;
        const x = sensordata[at + 1]!;
        const y = sensordata[at + 2]!;
        const z = sensordata[at + 3]!;
        this.forces_N[2 * i + finger] = found ? Math.sqrt(x * x + y * y + z * z) : 0;
      }
      const next = this.filters[i]!.step(
        graspSignal({
          bend: closed ? 1 : 0,
          distance_m: touching > 0 ? 0 : Number.POSITIVE_INFINITY,
          between: touching === 2,
          graspable: true,
        }),
        dt_s,
      );
      if ((next === "held") !== (this.signals[i] === "held")) changed = true;
      this.signals[i] = next;
    }
    return changed;
  }

  /** The first part that a finger has pressed harder than that for a while, not only at a knock, or −1. */
  pressedBeyond(force_N: number, dt_s: number): number {
    for (let k = 0; k < this.forces_N.length; k++) {
      this.pressed_s[k] = this.forces_N[k]! > force_N ? this.pressed_s[k]! + dt_s : 0;
      if (this.pressed_s[k]! >= PRESSED_S) return k >> 1;
    }
    return -1;
  }
  hardest_N(part: number): number {
    return Math.max(this.forces_N[2 * part]!, this.forces_N[2 * part + 1]!);
  }

  reset(): void {
    for (const filter of this.filters) filter.reset();
    this.signals.fill("free");
    this.forces_N.fill(0);
    this.pressed_s.fill(0);
  }
}
