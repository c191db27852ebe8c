import { graspSignal, type GraspSignal, type PhysicalScene } from "@twincell/core";
import { TOUCH_SIZE } from "./model/scene.ts";

/** Watches which parts the fingers touch and hold. */
export class Grasps {
  readonly signals: GraspSignal[];
  /** Force of each finger on each part, as felt last [N]. */
  readonly forces_N: Float64Array;
  private readonly hand: boolean;
  constructor({ gripper }: PhysicalScene, parts: number) {
    this.hand = gripper !== undefined;
    this.signals = Array.from({ length: parts }, () => "free");
    this.forces_N = new Float64Array(2 * parts);
  }

  /** @returns whether what is held changed. */
  sense(sensordata: Float64Array, closed: boolean): boolean {
    if (!this.hand) return false;
    const parts = this.signals.length;
    let changed = false;
    for (let i = 0; i < parts; i++) {
      let touching = 0;
      for (let finger = 0; finger < 2; finger++) {
        const at = TOUCH_SIZE * (finger * parts + i), found = sensordata[at]! > 0;
        if (found) touching++;
        const x = sensordata[at + 1]!, y = sensordata[at + 2]!, z = sensordata[at + 3]!;
        this.forces_N[2 * i + finger] = found ? Math.sqrt(x * x + y * y + z * z) : 0;
      }
      const next = graspSignal({ bend: closed ? 1 : 0, distance_m: touching > 0 ? 0 : Number.POSITIVE_INFINITY, between: touching === 2, graspable: true });
      if ((next === "held") !== (this.signals[i] === "held")) changed = true;
      this.signals[i] = next;
    }
    return changed;
  }

  reset(): void { this.signals.fill("free"); this.forces_N.fill(0); }
}
