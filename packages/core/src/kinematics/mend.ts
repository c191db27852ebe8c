import type { SerialArm } from "../model/arm.ts";
import { compose, copyPose, identity, inverse, type Pose } from "../spatial/pose.ts";
import { normalizeQuaternion } from "../spatial/quaternion.ts";
import { flangePose } from "./forward.ts";
import { refine, type HeldElbow, type RefineScratch } from "./refine.ts";
import { solveSphericalSeven } from "./spherical-seven.ts";

/** Working memory of `mend`. */
export interface MendScratch {
  readonly q: Float64Array;
  readonly raw: Float64Array;
  readonly target: Pose<"base", "flange">;
  readonly is: Pose<"base", "flange">;
  readonly flangeFromBase: Pose<"flange", "base">;
  readonly step: Pose<"flange", "flange">;
}
export const mendScratch = (): MendScratch => ({
  q: new Float64Array(7),
  raw: new Float64Array(56),
  target: identity(),
  is: identity(),
  flangeFromBase: identity(),
  step: identity(),
});

const VERIFIED = 1e-9;
const CORRECTIONS = 4;

/**
 * Posture s of a formula that the arm misses by tenths of a millimetre, made a posture of the arm with the same elbow
 * angle: by Newton's method, and where that goes astray (close to a singularity) after moving the formula's target by
 * what was missed:
 *
 *   target ← target · flange(q)⁻¹ · wanted,   q ← formula⁻¹(target)
 *
 * @param raw  postures of seven angles; the s-th is overwritten by the better one, or its first angle by NaN where
 *   there is none.
 */
export function mend(
  arm: SerialArm,
  wanted: Pose<"base", "flange">,
  held: HeldElbow,
  raw: Float64Array,
  s: number,
  count: number,
  scratch: MendScratch,
  newton: RefineScratch,
): void {
  const { q, target, is, flangeFromBase, step } = scratch;
  const { geometry, elbow_rad } = held;
  const at = 7 * s;
  for (let j = 0; j < 7; j++) q[j] = raw[at + j]!;
  let met = refine(arm, q, wanted, newton, held) < VERIFIED;
  if (!met) {
    for (let j = 0; j < 7; j++) q[j] = raw[at + j]!;
    copyPose(wanted, target);
    for (let k = 0; k < CORRECTIONS && !met; k++) {
      flangePose(arm, q, is, newton.jacobian.arm);
      compose(inverse(is, flangeFromBase), wanted, step);
      compose(target, step, target);
      normalizeQuaternion(target.quaternion, target.quaternion);
      if (solveSphericalSeven(geometry, target, elbow_rad, scratch.raw, q) !== count) break;
      for (let j = 0; j < 7; j++) q[j] = scratch.raw[at + j]!;
      met = refine(arm, q, wanted, newton, held) < VERIFIED;
      if (!met) for (let j = 0; j < 7; j++) q[j] = scratch.raw[at + j]!;
    }
  }
  for (let j = 0; j < 7; j++) raw[at + j] = q[j]!;
  if (!met) raw[at] = NaN;
}
