import { armScratch, flangePose } from "../kinematics/forward.ts";
import { nearestSolution, solverScratch } from "../kinematics/inverse.ts";
import type { Robot } from "../model/robot.ts";
import { compose, identity, inverse, type Pose } from "../spatial/pose.ts";
import { slerp } from "../spatial/quaternion.ts";
import { addScaled, distance, dot, lerp, subtract, type Vector3 } from "../spatial/vector.ts";

/** Where the tool of a joint move is farthest from the straight line between its ends. */
export interface LineDeviation {
  readonly deviation_m: number;
  readonly share: number;
}

/** Places looked at along a joint move before the worst is refined. */
const PLACES = 32;
/** Points put in between two taught ones at most. */
const MAX_POINTS = 4096;

/**
 * How far the TCP leaves the straight line between two postures when the joints are interpolated (row N-58).
 *
 *   max over share of  | p(share) − its nearest point of the segment p(0) p(1) |
 */
export function jointMoveDeviation(
  robot: Robot,
  q0: ArrayLike<number>,
  q1: ArrayLike<number>,
  flangeFromTcp: Pose<"flange", "tcp"> = identity(),
): LineDeviation {
  const n = q0.length;
  const q = new Float64Array(n);
  const scratch = armScratch();
  const flange = identity<"base", "flange">();
  const tcp = identity<"base", "tcp">();
  const at = (share: number): Vector3 => {
    for (let j = 0; j < n; j++) q[j] = q0[j]! + (q1[j]! - q0[j]!) * share;
    return [...compose(flangePose(robot.arm, q, flange, scratch), flangeFromTcp, tcp).position];
  };
  const a = at(0);
  const b = at(1);
  const off = (share: number): number => fromSegment(at(share), a, b);
  let best = 0;
  let share = 0;
  for (let k = 1; k < PLACES; k++) {
    const here = off(k / PLACES);
    if (here > best) {
      best = here;
      share = k / PLACES;
    }
  }
  // Golden section around the worst place: the deviation has one hump there.
  let low = share - 1 / PLACES;
  let high = share + 1 / PLACES;
  const ratio = (Math.sqrt(5) - 1) / 2;
  for (let k = 0; k < 30; k++) {
    const x = high - ratio * (high - low);
    const y = low + ratio * (high - low);
    if (off(x) > off(y)) high = y;
    else low = x;
  }
  const refined = (low + high) / 2;
  const value = off(refined);
  return value > best ? { deviation_m: value, share: refined } : { deviation_m: best, share };
}

/**
 * Postures along a straight TCP line between which joint interpolation keeps to the line; or the share of the line that
 * has none.
 */
export type LineConfigurations =
  | { readonly kind: "postures"; readonly q_rad: readonly Float64Array[]; readonly deviation_m: number }
  | { readonly kind: "out-of-reach"; readonly share: number };

/**
 * Extra points for a controller that only interpolates joints: the straight line from one TCP pose to the other is
 * halved wherever a joint move would leave it by more than `tolerance_m` (row N-58).
 *
 * @param q0  posture at `from`.
 * @returns   the postures after q0, the last of them at `to`, and the largest deviation that is left.
 */
export function configurationsAlongLine(
  robot: Robot,
  q0: Float64Array,
  from: Pose<"base", "tcp">,
  to: Pose<"base", "tcp">,
  tolerance_m: number,
  flangeFromTcp: Pose<"flange", "tcp"> = identity(),
): LineConfigurations {
  const tcpFromFlange = inverse(flangeFromTcp);
  const scratch = solverScratch();
  const found: Float64Array[] = [];
  const configuration = (share: number, near: Float64Array): Float64Array | undefined => {
    const tcp: Pose<"base", "tcp"> = {
      position: lerp(from.position, to.position, share),
      quaternion: slerp(from.quaternion, to.quaternion, share),
    };
    const q = new Float64Array(near.length);
    return nearestSolution(robot, compose(tcp, tcpFromFlange), near, q, scratch) ? q : undefined;
  };
  let share = 0;
  let q = q0;
  let left_m = 0;
  let step = 1;
  while (share < 1 - 1e-12) {
    if (found.length >= MAX_POINTS) return { kind: "out-of-reach", share };
    step = Math.min(step * 2, 1 - share);
    for (;;) {
      const next = configuration(share + step, q);
      const deviation = next === undefined ? undefined : jointMoveDeviation(robot, q, next, flangeFromTcp).deviation_m;
      if (next !== undefined && deviation !== undefined && deviation <= tolerance_m) {
        found.push(next);
        left_m = Math.max(left_m, deviation);
        q = next;
        share += step;
        break;
      }
      step /= 2;
      if (step < 1e-6) return { kind: "out-of-reach", share: share + step };
    }
  }
  return { kind: "postures", q_rad: found, deviation_m: left_m };
}

function fromSegment(p: Vector3, a: Vector3, b: Vector3): number {
  const along = subtract(b, a);
  const length2 = dot(along, along);
  const t = length2 > 0 ? Math.min(1, Math.max(0, dot(subtract(p, a), along) / length2)) : 0;
  return distance(p, addScaled(a, along, t));
}
