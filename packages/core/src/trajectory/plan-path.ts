import { armScratch, flangePose } from "../kinematics/forward.ts";
import type { Robot } from "../model/robot.ts";
import { isSlide } from "../model/slide.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import { radians } from "../spatial/units.ts";
import type { Plan } from "./plan.ts";
import { sampleSegment } from "./sample.ts";

/** Row L-39: what a joint limit says of a point of the path. */
export const POINT_OK = 0;
export const POINT_NEAR_LIMIT = 1;
export const POINT_BEYOND_LIMIT = 2;

/** The way of the TCP as a polyline, for drawing. Plain data. */
export interface PlanPath {
  /** 3 numbers a point: the TCP in the world [m]. */
  readonly points_m: Float32Array;
  /** Seconds after the start of the plan, one a point. */
  readonly times_s: Float64Array;
  /** Speed of the TCP [m/s], one a point (row L-35). */
  readonly speed_mps: Float32Array;
  /** `POINT_…`, one a point: blue, yellow or red. */
  readonly states: Uint8Array;
  /** Which points belong to which step: from `first`, `count` of them. In order; a step may come more than once. */
  readonly stretches: readonly { readonly step: string; readonly first: number; readonly count: number }[];
}

export interface PlanPathOptions {
  readonly worldFromBase?: Pose<"world", "base">;
  /** The tool whose point is followed in a step; the flange by default. */
  readonly flangeFromTcp?: (step: string) => Pose<"flange", "tcp">;
  /** Seconds between two points. */
  readonly period_s?: number;
  /** How near to its limit a joint must be for its points to count as near [rad]; 10° by default. */
  readonly near_rad?: number;
}

/** Follows the TCP through a plan: one point every `period_s`, and one at both ends of every motion. */
export function planPath(plan: Plan, robot: Robot, options: PlanPathOptions = {}): PlanPath {
  const { worldFromBase = identity<"world", "base">(), period_s = 0.02, near_rad = radians(10) } = options;
  const counts = plan.segments.map(segment =>
    segment.kind === "rest" ? 0 : 1 + Math.max(1, Math.ceil(segment.duration_s / period_s)),
  );
  const total = counts.reduce((sum, count) => sum + count, 0);
  const joints = robot.arm.joints;
  const n = joints.length;
  const points_m = new Float32Array(3 * total);
  const times_s = new Float64Array(total);
  const speed_mps = new Float32Array(total);
  const states = new Uint8Array(total);
  const stretches: { step: string; first: number; count: number }[] = [];
  const q = new Float64Array(n);
  const scratch = armScratch();
  const flange = identity<"base", "flange">();
  const worldFromFlange = identity<"world", "flange">();
  const tcp = identity<"world", "tcp">();
  // 10 mm of a slide are as near as 10° of a turn.
  const scales = joints.map(joint => (isSlide(joint) ? radians(10) / 0.01 : 1));
  let at = 0;
  for (let s = 0; s < plan.segments.length; s++) {
    const segment = plan.segments[s]!;
    const count = counts[s]!;
    if (count === 0) continue;
    const tool = options.flangeFromTcp?.(segment.step) ?? identity<"flange", "tcp">();
    const first = at;
    for (let k = 0; k < count; k++, at++) {
      const t = (segment.duration_s * k) / (count - 1);
      sampleSegment(segment, t, q);
      compose(worldFromBase, flangePose(robot.arm, q, flange, scratch), worldFromFlange);
      compose(worldFromFlange, tool, tcp);
      points_m.set(tcp.position, 3 * at);
      times_s[at] = segment.start_s + t;
      let room = Number.POSITIVE_INFINITY;
      for (let j = 0; j < n; j++)
        room = Math.min(
          room,
          (q[j]! - joints[j]!.limits.lower_rad) * scales[j]!,
          (joints[j]!.limits.upper_rad - q[j]!) * scales[j]!,
        );
      states[at] = room < -1e-9 ? POINT_BEYOND_LIMIT : room < near_rad ? POINT_NEAR_LIMIT : POINT_OK;
    }
    speeds(points_m, times_s, speed_mps, first, count);
    stretches.push({ step: segment.step, first, count });
  }
  return { points_m, times_s, speed_mps, states, stretches };
}

/** Central differences inside, towards the inside at the ends. */
function speeds(points: Float32Array, times: Float64Array, out: Float32Array, first: number, count: number): void {
  for (let k = 0; k < count; k++) {
    const a = first + Math.max(0, k - 1);
    const b = first + Math.min(count - 1, k + 1);
    const dt = times[b]! - times[a]!;
    const x = points[3 * b]! - points[3 * a]!;
    const y = points[3 * b + 1]! - points[3 * a + 1]!;
    const z = points[3 * b + 2]! - points[3 * a + 2]!;
    out[first + k] = dt > 0 ? Math.sqrt(x * x + y * y + z * z) / dt : 0;
  }
}
