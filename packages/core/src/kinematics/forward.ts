import { JointCountFault } from "../fault.ts";
import type { SerialArm } from "../robots/arm.ts";
import { compose, copyPose, identity, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle } from "../spatial/quaternion.ts";

/** Working memory of `flangePose` and its kin: one per caller, never shared between workers. */
export interface ArmScratch { readonly turn: Pose; readonly joint: Pose }
export const armScratch = (): ArmScratch => ({ turn: identity(), joint: identity() });

/**
 * Pose of the flange in the robot base.
 *
 *   baseFromFlange = Π_i ( parentFromJoint_i · Rot(axis_i, q_i) ) · lastJointFromFlange
 *
 * @param arm      n revolute joints, base first. Read only.
 * @param q        n joint angles [rad]. Range is not checked here: see `robots/limits.ts`.
 * @param out      receives the answer and is returned. Must not be a pose of `arm`.
 * @param scratch  working memory; with it and `out` the call allocates nothing.
 * @throws {JointCountFault} when q does not hold n angles.
 * @see Lynch & Park, Modern Robotics, Cambridge 2017, ch. 4.
 */
export function flangePose(
  arm: SerialArm, q: ArrayLike<number>, out: Pose<"base", "flange"> = identity(), scratch: ArmScratch = armScratch(),
): Pose<"base", "flange"> {
  const joints = arm.joints, n = joints.length;
  if (q.length !== n) throw new JointCountFault(arm.name, n, q.length);
  const running: Pose = out;
  copyPose(IDENTITY, running);
  for (let i = 0; i < n; i++) {
    const joint = joints[i]!;
    compose(running, joint.parentFromJoint as Pose, running);
    fromAxisAngle(joint.axis, q[i]!, scratch.turn.quaternion);
    compose(running, scratch.turn, running);
  }
  compose(running, arm.lastJointFromFlange as Pose, running);
  return out;
}

/**
 * Poses of all links in the robot base: out[0] is the base itself, out[i] the frame of joint i after its turn.
 *
 * @param out  n + 1 poses, written in place.
 */
export function linkPoses(arm: SerialArm, q: ArrayLike<number>, out: readonly Pose<"base", "link">[], scratch: ArmScratch = armScratch()): void {
  const joints = arm.joints, n = joints.length;
  if (q.length !== n) throw new JointCountFault(arm.name, n, q.length);
  copyPose(IDENTITY as Pose<"base", "link">, out[0]!);
  for (let i = 0; i < n; i++) {
    const joint = joints[i]!, link: Pose = out[i + 1]!;
    compose(out[i] as Pose, joint.parentFromJoint as Pose, link);
    fromAxisAngle(joint.axis, q[i]!, scratch.turn.quaternion);
    compose(link, scratch.turn, link);
  }
}

const IDENTITY: Pose = identity();
