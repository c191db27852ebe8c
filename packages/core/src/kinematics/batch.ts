import type { SerialArm } from "../model/arm.ts";
import type { Robot } from "../model/robot.ts";
import { identity, type Pose } from "../spatial/pose.ts";
import { candidates, settle, solverScratch, type SolverScratch } from "./candidates.ts";
import { armScratch, flangePose, type ArmScratch } from "./forward.ts";

/** Numbers of one pose in a batch: x, y, z, then the quaternion x, y, z, w. */
export const POSE_STRIDE = 7;
/**
 * Slots for postures that `solveBatch` keeps for each pose: no arm of six joints has more, and seven joints have eight
 * for one elbow angle.
 */
export const BATCH_BRANCHES = 16;

/**
 * Answers of `solveBatch`: of pose i, `counts[i]` postures, the s-th from `q_rad[(i · BATCH_BRANCHES + s) · joints]`.
 */
export interface Batch {
  readonly q_rad: Float64Array;
  readonly counts: Uint8Array;
}
export const batchFor = (joints: number, poses: number): Batch => ({
  q_rad: new Float64Array(poses * BATCH_BRANCHES * joints),
  counts: new Uint8Array(poses),
});

/**
 * Flange poses of many postures, one after another: a pure function of typed arrays, for workers.
 *
 * @param q_rad  m × n angles [rad], base joint first.
 * @param out    receives m × 7 numbers. Returned.
 * @throws {JointCountFault} when the arm has another number of joints than `q_rad.length / (out.length / 7)`.
 */
export function flangePoseBatch(
  arm: SerialArm,
  q_rad: Float64Array,
  out: Float64Array = new Float64Array((q_rad.length / arm.joints.length) * POSE_STRIDE),
  scratch: ArmScratch = armScratch(),
): Float64Array {
  const count = out.length / POSE_STRIDE;
  const n = q_rad.length / count;
  const q = new Float64Array(n);
  const flange = identity<"base", "flange">();
  for (let i = 0; i < count; i++) {
    for (let j = 0; j < n; j++) q[j] = q_rad[i * n + j]!;
    flangePose(arm, q, flange, scratch);
    const { position: p, quaternion: r } = flange;
    const at = i * POSE_STRIDE;
    out[at] = p[0];
    out[at + 1] = p[1];
    out[at + 2] = p[2];
    out[at + 3] = r[0];
    out[at + 4] = r[1];
    out[at + 5] = r[2];
    out[at + 6] = r[3];
  }
  return out;
}

/**
 * All postures of many flange poses, each put back through forward kinematics (and refined where it needs it); limits
 * not looked at; postures that fall together on a singularity are one. A pure function of typed arrays, for workers.
 *
 * @param poses      m × 7 numbers: position [m], quaternion x, y, z, w of unit length. A pose that is none has no
 *   postures.
 * @param out        made for the arm's joints and m poses; the postures of pose i lie from i · BATCH_BRANCHES.
 *   Returned.
 * @param elbow_rad  of seven joints; 0 unless said.
 */
export function solveBatch(
  robot: Robot,
  poses: Float64Array,
  out: Batch = batchFor(robot.arm.joints.length, poses.length / POSE_STRIDE),
  elbow_rad = 0,
  scratch: SolverScratch = solverScratch(),
): Batch {
  const n = robot.arm.joints.length;
  const wanted: Pose<"base", "flange"> = identity();
  const { position, quaternion } = wanted;
  for (let i = 0; i < out.counts.length; i++) {
    const at = i * POSE_STRIDE;
    for (let k = 0; k < 3; k++) position[k] = poses[at + k]!;
    for (let k = 0; k < 4; k++) quaternion[k] = poses[at + 3 + k]!;
    const length2 = quaternion[0] ** 2 + quaternion[1] ** 2 + quaternion[2] ** 2 + quaternion[3] ** 2;
    const count = Math.abs(length2 - 1) < 2e-6 ? candidates(robot, wanted, undefined, elbow_rad, scratch) : 0;
    let kept = 0;
    for (let s = 0; s < count && kept < BATCH_BRANCHES; s++) {
      if (!settle(robot, wanted, s, scratch) || isKept(out.q_rad, i * BATCH_BRANCHES, kept, n, scratch.q)) continue;
      out.q_rad.set(scratch.q, (i * BATCH_BRANCHES + kept) * n);
      kept++;
    }
    out.counts[i] = kept;
  }
  return out;
}

/** Whether the same posture, up to whole turns and 1e-6 rad, is among those kept for the pose. */
function isKept(all: Float64Array, first: number, kept: number, n: number, q: Float64Array): boolean {
  for (let s = 0; s < kept; s++) {
    let same = true;
    for (let j = 0; j < n && same; j++) {
      const gap = Math.abs(all[(first + s) * n + j]! - q[j]!);
      same = gap < 1e-6 || Math.abs(gap - 2 * Math.PI) < 1e-6;
    }
    if (same) return true;
  }
  return false;
}
