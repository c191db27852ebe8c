import { linkPoses } from "../kinematics/forward.ts";
import { compose, identity, pose, type Pose } from "../spatial/pose.ts";
import { rotate } from "../spatial/quaternion.ts";
import { subtract } from "../spatial/vector.ts";
import type { Joint, SerialArm } from "../model/arm.ts";

/**
 * The same arm with its link frames at the joints and, all angles 0, turned as the base: only the axes say which way a
 * joint turns (row L-10). Poses of the flange are unchanged; poses of the links are the old ones turned.
 */
export function alignedWithBase(arm: SerialArm): SerialArm {
  const links = Array.from({ length: arm.joints.length + 1 }, () => identity<"base", "link">());
  linkPoses(arm, new Float64Array(arm.joints.length), links);
  const joints = arm.joints.map(
    (joint, i): Joint => ({
      ...joint,
      axis: rotate(links[i + 1]!.quaternion, joint.axis),
      parentFromJoint: pose(subtract(links[i + 1]!.position, links[i]!.position)),
    }),
  );
  const last = links[arm.joints.length]!;
  const flange = compose(last as Pose, arm.lastJointFromFlange as Pose);
  return {
    name: arm.name,
    joints,
    lastJointFromFlange: pose(subtract(flange.position, last.position), flange.quaternion),
  };
}
