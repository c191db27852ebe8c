import type { Joint } from "../model/arm.ts";
import { isSlide, jointText, movesTo } from "../model/slide.ts";
import { radians } from "../spatial/units.ts";
import type { MotionSegment } from "../trajectory/plan.ts";
import { LIMIT_SLACK_RAD } from "../trajectory/run.ts";
import { configurationRepairs, reachRepairs } from "./repairs.ts";
import { motions, type CheckScene } from "./scene.ts";

/** Row L-39: a joint this near to its limit is worth a warning [rad], of a slide [m]. */
export const NEAR_LIMIT_RAD = radians(10);
export const NEAR_LIMIT_M = 0.01;
/** How near to its limit a joint is worth a warning, in its own unit. */
export const nearLimit = (joint: Pick<Joint, "kind">): number => (isSlide(joint) ? NEAR_LIMIT_M : NEAR_LIMIT_RAD);
const angleUnit = (joint: Joint): "rad" | "m" => (isSlide(joint) ? "m" : "rad");

/** Joint angles over the whole motion, between the plan's nodes as well (rows L-39, L-40, L-56). */
export function checkLimits(scene: CheckScene): void {
  const joints = scene.robot.arm.joints;
  const n = joints.length;
  const named = new Set(
    scene.layout.obstacles
      .filter(({ stop }) => stop.kind === "goal" && stop.goal.reach.kind === "outside-limits")
      .map(({ move }) => move.step.id),
  );
  const extremes = new Extremes(n);
  let first = true;
  for (const segment of motions(scene)) {
    extremes.of(segment);
    for (let j = 0; j < n; j++) {
      const joint = joints[j]!;
      const { lower_rad, upper_rad } = joint.limits;
      const low = extremes.low[j]!;
      const high = extremes.high[j]!;
      const up = upper_rad - high <= low - lower_rad;
      const value = up ? high : low;
      const limit = up ? upper_rad : lower_rad;
      const room = up ? upper_rad - high : low - lower_rad;
      const local_s = up ? extremes.highAt_s[j]! : extremes.lowAt_s[j]!;
      const at_s = segment.start_s + local_s;
      // A joint that comes away from its limit is the business of the step that took it there.
      if (local_s === 0 && !first) continue;
      if (room < -LIMIT_SLACK_RAD) {
        if (named.has(segment.step)) continue;
        const move = scene.layout.moves.get(segment.step);
        const repairs = move === undefined ? [] : [...configurationRepairs(scene, move), ...reachRepairs(scene, move)];
        scene.add(segment.step, "bad", {
          code: "limits.joint",
          joint: j + 1,
          value,
          limit,
          unit: angleUnit(joint),
          at_s,
          sentence: `Joint ${j + 1} would ${movesTo(joint)} ${jointText(joint, value)}; its limit is ${jointText(joint, limit)}.`,
          repairs,
        });
      } else if (room < nearLimit(joint)) {
        scene.add(segment.step, "warn", {
          code: "limits.near",
          joint: j + 1,
          value,
          limit,
          unit: angleUnit(joint),
          at_s,
          sentence: `Joint ${j + 1} ${isSlide(joint) ? "slides" : "turns"} to ${jointText(joint, value)}, ${jointText(joint, Math.max(0, room))} before its limit of ${jointText(joint, limit)}.`,
          repairs: [],
        });
      }
    }
    first = false;
  }
}

/** Least and greatest angle of every joint over a motion, and when. */
export class Extremes {
  readonly low: Float64Array;
  readonly high: Float64Array;
  readonly lowAt_s: Float64Array;
  readonly highAt_s: Float64Array;
  private readonly joints: number;

  constructor(joints: number) {
    this.joints = joints;
    this.low = new Float64Array(joints);
    this.high = new Float64Array(joints);
    this.lowAt_s = new Float64Array(joints);
    this.highAt_s = new Float64Array(joints);
  }

  of({ times_s, q_rad, qd_rad_s }: MotionSegment): void {
    const n = this.joints;
    this.low.fill(Number.POSITIVE_INFINITY);
    this.high.fill(Number.NEGATIVE_INFINITY);
    for (let i = 0; i < times_s.length; i++) {
      for (let j = 0; j < n; j++) this.see(j, q_rad[i * n + j]!, times_s[i]!);
      if (i + 1 === times_s.length) break;
      const t0 = times_s[i]!;
      const h = times_s[i + 1]! - t0;
      if (h <= 0) continue;
      for (let j = 0; j < n; j++) {
        const a = i * n + j;
        const d0 = qd_rad_s[a]!;
        const d1 = qd_rad_s[a + n]!;
        const rise = (q_rad[a + n]! - q_rad[a]!) / h;
        // The cubic's derivative in Bernstein form is d0, m, d1: without a change of sign there is no turning point
        // inside.
        const m = 3 * rise - d0 - d1;
        if ((d0 >= 0 && m >= 0 && d1 >= 0) || (d0 <= 0 && m <= 0 && d1 <= 0)) continue;
        // (d0 − 2m + d1) u² + 2 (m − d0) u + d0 = 0, solved without cancellation.
        const qa = d0 - 2 * m + d1;
        const qb = m - d0;
        const root2 = qb * qb - qa * d0;
        if (root2 < 0) continue;
        const k = -(qb + (qb < 0 ? -1 : 1) * Math.sqrt(root2));
        this.turn(j, qa === 0 ? Number.NaN : k / qa, q_rad[a]!, q_rad[a + n]!, d0, d1, h, t0);
        this.turn(j, k === 0 ? Number.NaN : d0 / k, q_rad[a]!, q_rad[a + n]!, d0, d1, h, t0);
      }
    }
  }

  private turn(j: number, u: number, q0: number, q1: number, d0: number, d1: number, h: number, t0: number): void {
    if (!(u > 0 && u < 1)) return;
    const u2 = u * u;
    const u3 = u2 * u;
    this.see(j, q0 + (q1 - q0) * (3 * u2 - 2 * u3) + (d0 * (u3 - 2 * u2 + u) + d1 * (u3 - u2)) * h, t0 + u * h);
  }

  private see(j: number, q: number, t_s: number): void {
    if (q < this.low[j]!) {
      this.low[j] = q;
      this.lowAt_s[j] = t_s;
    }
    if (q > this.high[j]!) {
      this.high[j] = q;
      this.highAt_s[j] = t_s;
    }
  }
}
