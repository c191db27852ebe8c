import type { Robot } from "../model/robot.ts";
import type { Plan, Segment } from "./plan.ts";
import { sampleSegment } from "./sample.ts";

/** Something a plan must not do. Joint counts from 1; 0 where no joint is meant. */
export interface PlanFlaw {
  readonly code:
    | "plan.order"
    | "plan.gap"
    | "plan.kink"
    | "plan.not-a-number"
    | "plan.limit"
    | "plan.speed"
    | "plan.acceleration";
  readonly step: string;
  readonly joint: number;
  readonly at_s: number;
  readonly value: number;
  readonly limit: number;
}

export interface JudgeOptions {
  /** Seconds between two looks. */
  readonly period_s?: number;
  /** Share by which speed and acceleration may be over their limits. */
  readonly slack?: number;
}

/** Angles [rad] and speeds [rad/s] this far apart at a border are the same. */
const SAME_RAD = 1e-6;
const SAME_RAD_S = 1e-3;

/**
 * Judges a plan by its numbers alone, whoever made it: order in time, no jumps of angle between segments, no jumps of
 * speed, joint limits, and speed and acceleration by differences of the sampled angles,
 *
 *   q̇ ≈ (q(t + h) − q(t − h)) / 2h,   q̈ ≈ (q(t + h) − 2 q(t) + q(t − h)) / h²
 *
 * The worst of each kind and joint in each segment is reported.
 */
export function judgePlan(plan: Plan, robot: Robot, options: JudgeOptions = {}): PlanFlaw[] {
  const { period_s = 0.002, slack = 1e-3 } = options;
  const n = robot.arm.joints.length;
  const flaws: PlanFlaw[] = [];
  const worst = new Map<string, PlanFlaw>();
  const at = new Float64Array(n);
  const speed = new Float64Array(n);
  const lastQ = new Float64Array(n);
  const lastSpeed = new Float64Array(n);
  let end_s = 0;
  let begun = false;
  for (const segment of plan.segments) {
    worst.clear();
    const report: Report = (code, joint, t, value, limit) => {
      const key = `${code} ${joint}`;
      const known = worst.get(key);
      if (known === undefined || Math.abs(value) > Math.abs(known.value))
        worst.set(key, { code, step: segment.step, joint, at_s: segment.start_s + t, value, limit });
    };
    judgeOrder(segment, end_s, report);
    sampleSegment(segment, 0, at, speed);
    for (let j = 0; j < n && begun; j++) {
      if (Math.abs(at[j]! - lastQ[j]!) > SAME_RAD) report("plan.gap", j + 1, 0, at[j]! - lastQ[j]!, SAME_RAD);
      if (Math.abs(speed[j]! - lastSpeed[j]!) > SAME_RAD_S)
        report("plan.kink", j + 1, 0, speed[j]! - lastSpeed[j]!, SAME_RAD_S);
    }
    judgeMotion(segment, robot, period_s, slack, report);
    sampleSegment(segment, segment.duration_s, lastQ, lastSpeed);
    end_s = segment.start_s + segment.duration_s;
    begun = true;
    flaws.push(...worst.values());
  }
  return flaws;
}

/** A flaw of the segment being judged; `t` counts from its start [s]. */
type Report = (code: PlanFlaw["code"], joint: number, t: number, value: number, limit: number) => void;

/** Each segment begins where the one before ends, and its own times go forward. */
function judgeOrder(segment: Segment, end_s: number, report: Report): void {
  if (Math.abs(segment.start_s - end_s) > 1e-9 || segment.duration_s < 0)
    report("plan.order", 0, 0, segment.start_s, end_s);
  if (segment.kind !== "motion") return;
  for (let i = 0; i + 1 < segment.times_s.length; i++)
    if (!(segment.times_s[i + 1]! > segment.times_s[i]!))
      report("plan.order", 0, segment.times_s[i]!, segment.times_s[i + 1]!, segment.times_s[i]!);
}

/** Joint limits, speed and acceleration of one segment, looked at every `period_s`. */
function judgeMotion(segment: Segment, robot: Robot, period_s: number, slack: number, report: Report): void {
  const joints = robot.arm.joints;
  const n = joints.length;
  const before = new Float64Array(n);
  const at = new Float64Array(n);
  const after = new Float64Array(n);
  const looks = Math.max(1, Math.ceil(segment.duration_s / period_s));
  const h = segment.duration_s / looks / 2;
  for (let k = 0; k <= looks; k++) {
    const t = (segment.duration_s * k) / looks;
    sampleSegment(segment, t, at);
    for (let j = 0; j < n; j++) {
      const { lower_rad, upper_rad } = joints[j]!.limits;
      if (!Number.isFinite(at[j]!)) report("plan.not-a-number", j + 1, t, at[j]!, 0);
      if (at[j]! > upper_rad + 1e-9) report("plan.limit", j + 1, t, at[j]!, upper_rad);
      if (at[j]! < lower_rad - 1e-9) report("plan.limit", j + 1, t, at[j]!, lower_rad);
    }
    if (k === 0 || k === looks || h <= 0) continue;
    sampleSegment(segment, t - h, before);
    sampleSegment(segment, t + h, after);
    for (let j = 0; j < n; j++) {
      const { speed_rad_s, acceleration_rad_s2 } = joints[j]!.limits;
      const rate = (after[j]! - before[j]!) / (2 * h);
      const bend = (after[j]! - 2 * at[j]! + before[j]!) / (h * h);
      if (Math.abs(rate) > speed_rad_s * (1 + slack)) report("plan.speed", j + 1, t, rate, speed_rad_s);
      if (Math.abs(bend) > acceleration_rad_s2 * (1 + slack))
        report("plan.acceleration", j + 1, t, bend, acceleration_rad_s2);
    }
  }
}
