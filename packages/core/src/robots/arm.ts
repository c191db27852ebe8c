import type { Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";

export interface JointLimits {
  readonly lower_rad: number;
  readonly upper_rad: number;
  readonly speed_rad_s: number;
  /** Published by nobody for most arms: then an assumption, said so in `Robot.assumptions`. */
  readonly acceleration_rad_s2: number;
}

/** A revolute joint. childFromParent at angle q: parentFromJoint · Rot(axis, q). */
export interface Joint {
  readonly name: string;
  readonly parentFromJoint: Pose<"parent", "joint">;
  /** Unit vector in the joint's own frame. */
  readonly axis: Vector3;
  readonly limits: JointLimits;
}

/** A chain of revolute joints, base first. Read-only for every algorithm; JSON-able. */
export interface SerialArm {
  readonly name: string;
  readonly joints: readonly Joint[];
  readonly lastJointFromFlange: Pose<"joint", "flange">;
}
