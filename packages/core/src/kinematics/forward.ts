import type { SerialArm } from "../model/arm.ts";
import { identity, type Pose } from "../spatial/pose.ts";
import { chainOf, keptScratch, walk, type ArmScratch } from "./chain.ts";
import { elbowFlange } from "./elbow-chain.ts";

export { armScratch, type ArmScratch } from "./chain.ts";

/**
 * Pose of the flange in the robot base.
 *
 *   baseFromFlange = Π_i ( parentFromJoint_i · Rot(axis_i, q_i) ) · lastJointFromFlange,
 *   Trans(axis_i q_i) where joint i slides
 *
 * @param arm      n joints, base first. Read only.
 * @param q        n joint values [rad; m of a slide]. Range is not checked here: see the joints' limits.
 * @param out      receives the answer and is returned. Must not be a pose of `arm`.
 * @param scratch  working memory; with it and `out` the call allocates nothing.
 * @throws {JointCountFault} when q does not hold n values.
 * @see Lynch & Park, Modern Robotics, Cambridge 2017, ch. 4.
 */
export function flangePose(
  arm: SerialArm,
  q: ArrayLike<number>,
  out: Pose<"base", "flange"> = identity(),
  scratch: ArmScratch = keptScratch(arm),
): Pose<"base", "flange"> {
  const chain = chainOf(arm, q, scratch);
  if (scratch.elbow === null) walk(chain, q, out, null, null);
  else elbowFlange(scratch.elbow, q, out, scratch.trig);
  return out;
}

/**
 * Poses of all links in the robot base: out[0] is the base itself, out[i] the frame of joint i after its motion.
 *
 * @param out  n + 1 poses, written in place.
 */
export function linkPoses(
  arm: SerialArm,
  q: ArrayLike<number>,
  out: readonly Pose<"base", "link">[],
  scratch: ArmScratch = keptScratch(arm),
): void {
  walk(chainOf(arm, q, scratch), q, null, out, null);
}
