import type { Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";

/**
 * Limits of a joint. The names are those of a joint that turns; of a joint that slides the same fields hold m, m/s,
 * m/s², m/s³ and N (docs/decisions/0012): `slideLimits` writes them by their own names, `jointText` says them in their
 * own unit.
 */
export interface JointLimits {
  readonly lower_rad: number;
  readonly upper_rad: number;
  readonly speed_rad_s: number;
  /** Published by nobody for most arms: then an assumption, said so in `Robot.assumptions`. */
  readonly acceleration_rad_s2: number;
  /** Published by hardly anybody: left out, `jerkOf` says what is assumed. */
  readonly jerk_rad_s3?: number;
  /** Greatest torque at the joint, where it is published [N m]. */
  readonly torque_Nm?: number;
}

/** Motor and gear of a joint, where they are published. */
export interface JointDrive {
  readonly motorTorque_Nm: number;
  readonly motorSpeed_rpm: number;
  /** Turns of the motor per turn of the joint. */
  readonly gear: number;
  /** Motor and gear as the motor feels them: at the joint it is gear² times as much [kg m²]. */
  readonly rotorInertia_kgm2: number;
}

/** Mass of a link, where it is published; the rest of it only where that is published as well. */
export interface LinkMass {
  readonly mass_kg: number;
  /** Centre of mass in the link's frame, with the directions the inertia is given in. */
  readonly linkFromCentre?: Pose<"link", "centre">;
  /** Ixx, Iyy, Izz, Ixy, Ixz, Iyz about the centre of mass [kg m²]. */
  readonly inertia_kgm2?: readonly [number, number, number, number, number, number];
}

/**
 * One joint of a chain. Its child at value q:
 *
 *   revolute    parentFromJoint · Rot(axis, q)          q [rad]
 *   prismatic   parentFromJoint · Trans(axis · q)       q [m]
 */
export interface Joint {
  readonly name: string;
  /** Revolute when left out. */
  readonly kind?: "revolute" | "prismatic";
  readonly parentFromJoint: Pose<"parent", "joint">;
  /** Unit vector in the joint's own frame. */
  readonly axis: Vector3;
  readonly limits: JointLimits;
  readonly drive?: JointDrive;
}

/** A chain of joints, base first. Read-only for every algorithm; JSON-able. */
export interface SerialArm {
  readonly name: string;
  readonly joints: readonly Joint[];
  readonly lastJointFromFlange: Pose<"joint", "flange">;
}
