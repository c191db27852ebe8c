import { flangePose } from "../kinematics/forward.ts";
import type { JointLimits } from "../model/arm.ts";
import { jerkOf } from "../model/jerk.ts";
import type { Robot } from "../model/robot.ts";
import { compose } from "../spatial/pose.ts";
import { distance } from "../spatial/vector.ts";
import { sCurve, type RestProfile } from "./laws.ts";
import type { Move } from "./moves.ts";
import type { MotionSegment } from "./plan.ts";
import { paceOf, type Slowed, type TimedRun } from "./run-timing.ts";

/** Places along a joint leg at which the speed of its TCP is looked at. */
const PLACES = 16;

/**
 * The joint move that starts and ends at rest: all joints together along one line, on a rounded trapezoid of speed
 * whose few knots the plan's cubics pass exactly. The joint with the least room rules speed, acceleration and jerk.
 */
export function timeJointLeg(move: Move, q0: Float64Array, q1: Float64Array, robot: Robot): TimedRun {
  const n = q0.length;
  const step = move.step;
  const pace = paceOf(step.speed, "ptp", robot);
  const slowed: Slowed[] = [];
  const share = step.acceleration?.ratio ?? 1;
  let fastest = Number.POSITIVE_INFINITY;
  let acceleration = Number.POSITIVE_INFINITY;
  let jerk = Number.POSITIVE_INFINITY;
  let ruling = 0;
  for (let j = 0; j < n; j++) {
    const way = Math.abs(q1[j]! - q0[j]!);
    const limits = robot.arm.joints[j]!.limits;
    if (way === 0) continue;
    if (limits.speed_rad_s / way < fastest) {
      fastest = limits.speed_rad_s / way;
      ruling = j;
    }
    acceleration = Math.min(acceleration, (limits.acceleration_rad_s2 * share) / way);
    jerk = Math.min(jerk, jerkOf(limits) / way);
  }
  if (!(fastest < Number.POSITIVE_INFINITY))
    return { parts: [segment(move, 0, new Float64Array(1), q0.slice(), new Float64Array(n))], slowed, duration_s: 0 };
  const way = Math.abs(q1[ruling]! - q0[ruling]!);
  const limit = robot.arm.joints[ruling]!.limits.speed_rad_s;
  let rate = fastest * pace.ratio;
  if (pace.mps < Number.POSITIVE_INFINITY) {
    const wanted = pace.mps / tcpSlope(move, q0, q1, robot);
    if (wanted > fastest) slowed.push({ move: 0, joint: ruling + 1, wanted: wanted * way, limit, unit: "rad/s", s: 0 });
    rate = Math.min(fastest, wanted);
  }
  let law = sCurve(1, rate, acceleration, jerk);
  const least_s = law.times_s.at(-1)!;
  if (pace.time_s > 0 && pace.time_s < least_s * (1 - 1e-9))
    slowed.push(hardest(q0, q1, law, least_s / pace.time_s, robot));
  if (pace.time_s > least_s) law = sCurve(1, rate, acceleration, jerk, pace.time_s / least_s);
  const knots = law.times_s.length;
  const q = new Float64Array(knots * n);
  const qd = new Float64Array(knots * n);
  for (let k = 0; k < knots; k++) {
    for (let j = 0; j < n; j++) {
      q[k * n + j] = k === knots - 1 ? q1[j]! : q0[j]! + (q1[j]! - q0[j]!) * law.place[k]!;
      qd[k * n + j] = (q1[j]! - q0[j]!) * law.speed[k]!;
    }
  }
  const duration_s = law.times_s[knots - 1]!;
  return { parts: [segment(move, duration_s, law.times_s, q, qd)], slowed, duration_s };
}

const segment = (
  move: Move,
  duration_s: number,
  times_s: Float64Array,
  q_rad: Float64Array,
  qd_rad_s: Float64Array,
): MotionSegment => ({
  kind: "motion",
  path: move.step.path,
  step: move.step.id,
  start_s: 0,
  duration_s,
  times_s,
  q_rad,
  qd_rad_s,
});

/**
 * The joint furthest over its limit when the same leg takes a shorter time, by `factor`: of speed where there is one,
 * since that is the plainest reason, then of acceleration, then of jerk.
 */
function hardest(q0: Float64Array, q1: Float64Array, law: RestProfile, factor: number, robot: Robot): Slowed {
  // The law begins with constant jerk up to its highest acceleration.
  const first_s = law.times_s[1]!;
  const jerk = (2 * law.speed[1]!) / (first_s * first_s);
  const kinds = [
    { unit: "rad/s", asked: Math.max(...law.speed) * factor, limitOf: (limits: JointLimits) => limits.speed_rad_s },
    {
      unit: "rad/s2",
      asked: jerk * first_s * factor ** 2,
      limitOf: (limits: JointLimits) => limits.acceleration_rad_s2,
    },
    { unit: "rad/s3", asked: jerk * factor ** 3, limitOf: jerkOf },
  ] as const;
  let found: Slowed = { move: 0, joint: 1, wanted: 0, limit: 1, unit: "rad/s3", s: 0 };
  for (const { unit, asked, limitOf } of kinds) {
    for (let j = 0; j < q0.length; j++) {
      const wanted = Math.abs(q1[j]! - q0[j]!) * asked;
      const limit = limitOf(robot.arm.joints[j]!.limits);
      if (wanted / limit > found.wanted / found.limit) found = { move: 0, joint: j + 1, wanted, limit, unit, s: 0 };
    }
    if (found.wanted > found.limit) return found;
  }
  return found;
}

/** Largest way of the TCP per share of the leg [m]. */
function tcpSlope(move: Move, q0: Float64Array, q1: Float64Array, robot: Robot): number {
  const at = (share: number): readonly number[] =>
    compose(
      flangePose(
        robot.arm,
        q0.map((a, j) => a + (q1[j]! - a) * share),
      ),
      move.flangeFromTcp,
    ).position;
  let most = 1e-9;
  let last = at(0);
  for (let k = 1; k <= PLACES; k++) {
    const next = at(k / PLACES);
    most = Math.max(most, distance([last[0]!, last[1]!, last[2]!], [next[0]!, next[1]!, next[2]!]) * PLACES);
    last = next;
  }
  // The chords are a little shorter than the arc between them.
  return most * 1.01;
}
