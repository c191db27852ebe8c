import { identity, type Pose } from "../../spatial/pose.ts";
import { jacobianScratch, type JacobianScratch } from "../jacobian.ts";

/** Working memory of the damped solver for arms of n joints: one per caller. */
export interface DampedScratch {
  readonly jacobian: JacobianScratch;
  readonly rows: Float64Array;
  readonly normal: Float64Array;
  readonly factor: Float64Array;
  readonly uphill: Float64Array;
  readonly step: Float64Array;
  readonly trial: Float64Array;
  readonly error: Float64Array;
  readonly trialError: Float64Array;
  /** 1 where a joint stands at a limit and is pressed against it. */
  readonly pressed: Uint8Array;
  readonly flange: Pose<"base", "flange">;
  /** Posture, iterations and errors of the last descent. */
  readonly q: Float64Array;
  readonly best: Float64Array;
  iterations: number;
  position_m: number;
  angle_rad: number;
}
export const dampedScratch = (joints = 6): DampedScratch => ({
  jacobian: jacobianScratch(joints),
  rows: new Float64Array(6 * joints),
  normal: new Float64Array(joints * joints),
  factor: new Float64Array(joints * joints),
  uphill: new Float64Array(joints),
  step: new Float64Array(joints),
  trial: new Float64Array(joints),
  error: new Float64Array(6),
  trialError: new Float64Array(6),
  pressed: new Uint8Array(joints),
  flange: identity(),
  q: new Float64Array(joints),
  best: new Float64Array(joints),
  iterations: 0,
  position_m: 0,
  angle_rad: 0,
});
