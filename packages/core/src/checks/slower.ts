import type { MoveStep, Speed } from "../program/program.ts";
import type { Repair } from "./verdict.ts";
import { metresPerSecond, seconds, type CheckScene } from "./scene.ts";

/**
 * The step with a speed that every joint can follow, and a little to spare.
 *
 * @param factor  by how much it is too fast now, above 1.
 * @param stretch by how much longer than planned a step of given duration has to take.
 */
export function slower(scene: CheckScene, step: MoveStep, factor: number, stretch = 1): Repair[] {
  const spare = 1.02;
  const speed = step.speed;
  const replace = (next: Speed, sentence: string): Repair[] => [
    { kind: "slower", sentence, replace: { ...step, speed: next } },
  ];
  if ("mps" in speed) {
    const mps = floored(speed.mps / (factor * spare));
    return replace({ mps }, `Lower the speed to ${metresPerSecond(mps)}.`);
  }
  if ("ratio" in speed) {
    const ratio = floored(speed.ratio / (factor * spare));
    return replace({ ratio }, `Lower the speed to ${(ratio * 100).toPrecision(2)} %.`);
  }
  // A duration that was too short was not kept: the plan's own is the shortest there is.
  const least_s = scene.layout.plan.segments
    .filter(segment => segment.step === step.id)
    .reduce((sum, segment) => sum + segment.duration_s, 0);
  const time_s = Math.ceil(least_s * stretch * spare * 100) / 100;
  return replace({ time_s }, `Give it ${seconds(time_s)}.`);
}

/** Rounded down to two digits. */
function floored(x: number): number {
  const unit = 10 ** (Math.floor(Math.log10(x)) - 1);
  return Number((Math.floor(x / unit) * unit).toPrecision(2));
}
