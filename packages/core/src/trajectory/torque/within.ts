import { inverseDynamics } from "../../dynamics/inverse-dynamics.ts";
import type { DynamicsModel } from "../../dynamics/model.ts";
import { dynamicsScratch } from "../../dynamics/placed.ts";
import type { MotionSegment, Segment } from "../plan.ts";
import { eachInstant, jointState } from "./instants.ts";

/** Time between two instants at which torques are looked at [s]. */
export const TORQUE_PERIOD_S = 0.004;
/** Share of the limits that a slowed motion uses: the rest covers what lies between two instants. */
const TORQUE_SHARE = 0.999;

/** The instant of some motions that asks most of a joint. Joints count from 1. */
export interface TorquePeak {
  readonly joint: number;
  /** Index of the segment, and seconds after its start. */
  readonly segment: number;
  readonly t_s: number;
  readonly torque_Nm: number;
  /** What of it holds the arm up. */
  readonly weight_Nm: number;
  readonly limit_Nm: number;
  /**
   * Share of its speed at which the motion would keep within the limit here: 1 when it does, 0 when the weight alone is
   * too much.
   */
  readonly share: number;
}

/**
 * Share of speed at which a torque fits: with all times 1/s as long, inertia and centrifugal torques fall with s², the
 * weight does not.
 *
 *   |g + (τ − g) s²| ≤ τ_max
 */
export function shareWithin(torque_Nm: number, weight_Nm: number, limit_Nm: number): number {
  if (Math.abs(torque_Nm) <= limit_Nm) return 1;
  if (Math.abs(weight_Nm) >= limit_Nm) return 0;
  const moving = torque_Nm - weight_Nm;
  return Math.sqrt((Math.sign(moving) * limit_Nm - weight_Nm) / moving);
}

/**
 * Of every joint the instant that asks most of it: the one that has to be slowed most, else the one with the greatest
 * share of its limit.
 *
 * @param models  one for each segment.
 * @returns one peak a joint; joints whose limit is not known have an infinite one.
 */
export function torquePeaks(
  segments: readonly Segment[],
  models: readonly DynamicsModel[],
  limits_Nm: Float64Array,
  period_s = TORQUE_PERIOD_S,
): TorquePeak[] {
  const n = limits_Nm.length;
  const peaks = new Array<TorquePeak | undefined>(n).fill(undefined);
  const state = jointState(n);
  const none = new Float64Array(n);
  const torque = none.slice();
  const weight = none.slice();
  const scratch = models[0] === undefined ? undefined : dynamicsScratch(models[0]);
  segments.forEach((segment, s) => {
    const model = models[s]!;
    eachInstant(segment, period_s, state, () => {
      inverseDynamics(model, state.q, state.qd, state.qdd, torque, scratch);
      let weighed = false;
      for (let j = 0; j < n; j++) {
        const most = peaks[j];
        const value = torque[j]!;
        const limit_Nm = limits_Nm[j]!;
        if (most !== undefined && Math.abs(value) <= limit_Nm && Math.abs(value) <= Math.abs(most.torque_Nm)) continue;
        if (!weighed) {
          inverseDynamics(model, state.q, none, none, weight, scratch);
          weighed = true;
        }
        const share = shareWithin(value, weight[j]!, limit_Nm);
        if (
          most !== undefined &&
          (share > most.share || (share === most.share && Math.abs(value) <= Math.abs(most.torque_Nm)))
        )
          continue;
        peaks[j] = {
          joint: j + 1,
          segment: s,
          t_s: state.t_s,
          torque_Nm: value,
          weight_Nm: weight[j]!,
          limit_Nm,
          share,
        };
      }
    });
  });
  return peaks.filter(peak => peak !== undefined);
}

/** The peak that a motion has to be slowed for most; undefined when all limits hold. */
export const worstPeak = (peaks: readonly TorquePeak[]): TorquePeak | undefined =>
  peaks.reduce<TorquePeak | undefined>((worst, peak) => (peak.share < (worst?.share ?? 1) ? peak : worst), undefined);

/** The motions at a share of their speed: the same way, all times 1/share as long. */
export const slowedBy = (parts: readonly MotionSegment[], share: number): MotionSegment[] =>
  parts.map(part => ({
    ...part,
    start_s: part.start_s / share,
    duration_s: part.duration_s / share,
    times_s: part.times_s.map(t_s => t_s / share),
    qd_rad_s: part.qd_rad_s.map(speed => speed * share),
  }));

/** Share of speed at which motions with that peak keep a little within the limits. */
export const keptShare = ({ torque_Nm, weight_Nm, limit_Nm }: TorquePeak): number =>
  shareWithin(torque_Nm, weight_Nm, limit_Nm * TORQUE_SHARE);
