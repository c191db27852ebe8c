import type { Pose } from "../../spatial/pose.ts";
import { angleBetween, normalizeQuaternion, type Quaternion } from "../../spatial/quaternion.ts";
import { distance, type Vector3 } from "../../spatial/vector.ts";
import type { Demonstration } from "./demonstration.ts";

/** Where the hand was when the gripper closed or opened, as well as its tremor lets it be known. */
export interface Grip {
  readonly closed: boolean;
  /** Index of the first sample with the gripper like that. */
  readonly sample: number;
  /** Mean over the rest of the hand around that sample. */
  readonly pose: Pose<"world", "tcp">;
  /** How far the hand went straight from there along its way, the shorter of before and after [m]. */
  readonly clear_m: number;
}

/** Samples of this long on both sides are averaged before the hand is asked whether it rests [s]. */
const SMOOTH_S = 0.1;
/** The smoothed hand rests while it is this near to where it was when the gripper changed [m]. */
const REST_M = 0.006;
/** A rest is looked for no further than this from the change [s]. */
const REST_S = 1.5;
/** The hand left the place of the grip sideways by this much [m]. */
const SIDEWAYS_M = 0.03;

/** Every change of the gripper with where it happened. Tremor that has no direction averages out over the rest. */
export function gripsOf(demonstration: Demonstration): Grip[] {
  const { closed } = demonstration;
  const smooth = smoothed(demonstration);
  const grips: Grip[] = [];
  closed.forEach((is, i) => {
    if (i === 0 || is === closed[i - 1]) return;
    const [first, last] = restAround(demonstration, smooth, i);
    const before = grips.at(-1)?.sample ?? 0;
    const next = closed.findIndex((other, k) => k > i && other !== is);
    const pose = meanOf(demonstration.worldFromTcp.slice(first, last + 1));
    const ways = [
      straightFrom(smooth, pose, first, before),
      straightFrom(smooth, pose, last, next < 0 ? smooth.length - 1 : next),
    ];
    grips.push({ closed: is, sample: i, pose, clear_m: Math.min(...ways) });
  });
  return grips;
}

/** Means over `SMOOTH_S` on both sides, fewer at the ends. */
function smoothed({ times_s, worldFromTcp }: Demonstration): Vector3[] {
  const out: Vector3[] = [];
  let from = 0;
  let to = -1;
  const sum: Vector3 = [0, 0, 0];
  const add = (i: number, sign: 1 | -1): void => {
    for (let k = 0; k < 3; k++) sum[k]! += sign * worldFromTcp[i]!.position[k]!;
  };
  times_s.forEach(t => {
    while (to + 1 < times_s.length && times_s[to + 1]! <= t + SMOOTH_S) add(++to, 1);
    while (times_s[from]! < t - SMOOTH_S) add(from++, -1);
    const count = to - from + 1;
    out.push([sum[0] / count, sum[1] / count, sum[2] / count]);
  });
  return out;
}

function restAround({ times_s }: Demonstration, smooth: readonly Vector3[], at: number): readonly [number, number] {
  const rests = (i: number): boolean =>
    i >= 0 &&
    i < smooth.length &&
    Math.abs(times_s[i]! - times_s[at]!) <= REST_S &&
    distance(smooth[i]!, smooth[at]!) <= REST_M;
  let first = at;
  let last = at;
  while (rests(first - 1)) first--;
  while (rests(last + 1)) last++;
  return [first, last];
}

/** How far the hand gets from the pose, from one sample to another, before it leaves its line from there sideways. */
function straightFrom(smooth: readonly Vector3[], { position, quaternion }: Pose, from: number, to: number): number {
  const [x, y, z, w] = quaternion;
  // Against z of the tool: where it comes from.
  const back: Vector3 = [-2 * (x * z + y * w), -2 * (y * z - x * w), -(1 - 2 * (x * x + y * y))];
  let most = 0;
  for (let i = from; i !== to; i += Math.sign(to - from)) {
    const off: Vector3 = [0, 1, 2].map(k => smooth[i]![k]! - position[k]!) as Vector3;
    const along = off[0] * back[0] + off[1] * back[1] + off[2] * back[2];
    const aside = Math.sqrt(Math.max(0, off[0] ** 2 + off[1] ** 2 + off[2] ** 2 - along * along));
    if (aside > SIDEWAYS_M) break;
    most = Math.max(most, along);
  }
  return most;
}

/** Mean position, and mean rotation of quaternions on one half of the sphere. */
export function meanOf(poses: readonly Pose<"world", "tcp">[]): Pose<"world", "tcp"> {
  const position: Vector3 = [0, 0, 0];
  const sum: Quaternion = [0, 0, 0, 0];
  const reference = poses[0]!.quaternion;
  for (const pose of poses) {
    for (let k = 0; k < 3; k++) position[k]! += pose.position[k]! / poses.length;
    const sign = pose.quaternion.reduce((dots, value, k) => dots + value * reference[k]!, 0) < 0 ? -1 : 1;
    for (let k = 0; k < 4; k++) sum[k]! += sign * pose.quaternion[k]!;
  }
  return { position, quaternion: normalizeQuaternion(sum) };
}

/** The nearest of some rotations where it is within that angle; otherwise the rotation itself. */
export function snappedRotation(rotation: Quaternion, choices: readonly Quaternion[], within_rad: number): Quaternion {
  let best = rotation;
  let least = within_rad;
  for (const choice of choices) {
    const angle = angleBetween(rotation, choice);
    if (angle > least) continue;
    least = angle;
    best = choice;
  }
  return best;
}
