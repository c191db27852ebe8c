import { JointCountFault } from "../../fault.ts";
import type { SerialArm } from "../../model/arm.ts";
import type { Pose } from "../../spatial/pose.ts";
import { distance } from "../../spatial/vector.ts";
import { armScratch, flangePose } from "../forward.ts";
import { flawOfPose, lengthAt, poseError } from "./pose-error.ts";

export interface GradientOptions {
  /** d of Eq 1: how far a joint is turned to feel the slope [rad]; 1e-4 unless said. Not published. */
  readonly sampling_rad?: number;
  /** L of Eq 3 [rad²/m], constant; 0.002 unless said. Not published. */
  readonly learningRate?: number;
  /** Sweeps over all joints; 2,000 unless said. */
  readonly sweeps?: number;
  /** Near enough [m]: 2e-3 unless said. A constant L circles about the target within about L and comes no nearer. */
  readonly near_m?: number;
  /**
   * Ours, not the paper's: halves L after a sweep that leads away and goes back, so that the distance falls to the end.
   */
  readonly backtracking?: boolean;
  /** Told of every joint in the order they are turned (row X-27). */
  readonly trace?: (step: GradientStep) => void;
}

/** One joint turned: Eq 1 and Eq 3 with their numbers. Joint from 1. */
export interface GradientStep {
  readonly sweep: number;
  readonly joint: number;
  readonly slope_m_rad: number;
  readonly from_rad: number;
  readonly to_rad: number;
  readonly distance_m: number;
}

/** Where gradient descent ended; `distance_m` before and after each sweep. */
export type GradientAnswer =
  | {
      readonly kind: "near" | "out-of-sweeps" | "settled";
      readonly q_rad: Float64Array;
      readonly iterations: number;
      readonly position_m: number;
      readonly angle_rad: number;
      readonly distance_m: readonly number[];
    }
  | { readonly kind: "not-a-pose"; readonly because: string };

/** Backtracking ends where L has become this small a share of what it was. */
const LEAST_SHARE = 1e-9;

/** f(x) = distance from the end effector to the target [m] (row X-23). */
export const distanceTo = (
  arm: SerialArm,
  target: Pose<"base", "flange">,
  q: ArrayLike<number>,
  scratch = armScratch(),
): number => distance(flangePose(arm, q, undefined, scratch).position, target.position);

/** Eq 1: ∂f/∂xᵢ ≈ [f(xᵢ + d) − f(xᵢ)] / d. Joint i from 0; `q` is put back. */
export function slopeOf(
  arm: SerialArm,
  target: Pose<"base", "flange">,
  q: Float64Array,
  i: number,
  sampling_rad: number,
  scratch = armScratch(),
): number {
  const here = distanceTo(arm, target, q, scratch);
  const angle = q[i]!;
  q[i] = angle + sampling_rad;
  const there = distanceTo(arm, target, q, scratch);
  q[i] = angle;
  return (there - here) / sampling_rad;
}

/**
 * Gradient descent as the thesis prints it (rows X-23 … X-27), on the place of the flange alone: its orientation is
 * what comes of it.
 *
 *   ∂f/∂xᵢ ≈ [f(xᵢ + d) − f(xᵢ)] / d        Eq 1
 *   direction = −gradient                     Eq 2
 *   xᵢ ← xᵢ − L · ∂f/∂xᵢ                      Eq 3
 *
 * Joints are turned one after the other, each from where the ones before it have led, beginning with the joint after
 * the base. Angles are cut at the joint limits.
 *
 * @param q0  n start angles [rad]. Read only.
 * @throws {JointCountFault} when `q0` does not hold n angles.
 */
export function solveGradient(
  arm: SerialArm,
  baseFromFlange: Pose<"base", "flange">,
  q0: ArrayLike<number>,
  options: GradientOptions = {},
): GradientAnswer {
  const {
    sampling_rad = 1e-4,
    learningRate = 0.002,
    sweeps = 2000,
    near_m = 2e-3,
    backtracking = false,
    trace,
  } = options;
  if (q0.length !== arm.joints.length) throw new JointCountFault(arm.name, arm.joints.length, q0.length);
  const because =
    flawOfPose(baseFromFlange) ??
    (Array.from(q0).every(Number.isFinite) ? undefined : "A start angle is not a finite number.");
  if (because !== undefined) return { kind: "not-a-pose", because };
  const q = Float64Array.from(q0);
  const before = q.slice();
  const scratch = armScratch();
  const distance_m = [distanceTo(arm, baseFromFlange, q, scratch)];
  const error = new Float64Array(6);
  let rate = learningRate;
  let kind: "near" | "out-of-sweeps" | "settled" = "out-of-sweeps";
  for (let sweep = 1; distance_m[distance_m.length - 1]! >= near_m && sweep <= sweeps; sweep++) {
    before.set(q);
    for (let i = 0; i < q.length; i++) {
      const slope_m_rad = slopeOf(arm, baseFromFlange, q, i, sampling_rad, scratch);
      const from_rad = q[i]!;
      const { lower_rad, upper_rad } = arm.joints[i]!.limits;
      q[i] = Math.min(upper_rad, Math.max(lower_rad, from_rad - rate * slope_m_rad));
      trace?.({
        sweep,
        joint: i + 1,
        slope_m_rad,
        from_rad,
        to_rad: q[i]!,
        distance_m: distanceTo(arm, baseFromFlange, q, scratch),
      });
    }
    const last = distance_m[distance_m.length - 1]!;
    const now = distanceTo(arm, baseFromFlange, q, scratch);
    if (backtracking && now >= last) {
      q.set(before);
      rate /= 2;
      distance_m.push(last);
      if (rate < LEAST_SHARE * learningRate) {
        kind = "settled";
        break;
      }
    } else distance_m.push(now);
  }
  if (distance_m[distance_m.length - 1]! < near_m) kind = "near";
  poseError(baseFromFlange, flangePose(arm, q, undefined, scratch), error);
  return {
    kind,
    q_rad: q,
    iterations: distance_m.length - 1,
    position_m: lengthAt(error, 0),
    angle_rad: lengthAt(error, 3),
    distance_m,
  };
}
