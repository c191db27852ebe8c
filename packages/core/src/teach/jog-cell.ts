import { armScratch, type ArmScratch } from "../kinematics/forward.ts";
import type { Branch } from "../kinematics/branch.ts";
import { solverScratch, type SolverScratch } from "../kinematics/candidates.ts";
import { MAX_BRANCHES } from "../kinematics/ortho-parallel.ts";
import type { Reach } from "../kinematics/reach.ts";
import type { DampedScratch } from "../kinematics/numeric/damped-scratch.ts";
import type { SerialArm } from "../model/arm.ts";
import type { Robot } from "../model/robot.ts";
import { identity, type Pose } from "../spatial/pose.ts";
import type { Quaternion } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";

/**
 * Which axes a Cartesian jog runs along: those of the world, the robot base, the tool tip, or worldFromUser of a work
 * frame.
 */
export type JogFrame = "world" | "base" | "tool" | Quaternion;

/** What the hand asks for: joint speeds [rad/s], or a twist of the tool tip [m/s, rad/s about the tip]. */
export type JogCommand =
  | { readonly kind: "joints"; readonly speed_rad_s: ArrayLike<number> }
  | { readonly kind: "tip"; readonly linear_mps: Vector3; readonly angular_rad_s: Vector3; readonly frame: JogFrame };

/** Where the arm stands and what it carries. */
export interface JogCell {
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
}

/** What jogging an arm by damped least squares needs beside the rest. */
export interface NumericJog {
  readonly arm: SerialArm;
  readonly damped: DampedScratch;
  readonly found: Float64Array;
  readonly baseFromStart: Pose<"base", "flange">;
  readonly turnWeight_m: number;
}

/** Working memory of `jogStep`: one per hand. Fits itself to the number of joints when it first meets an arm. */
export interface JogScratch {
  readonly raw: Float64Array;
  readonly ahead: Float64Array;
  readonly arm: ArmScratch;
  /** Of the candidates in `raw`: their number, what each costs; what settles one. */
  count: number;
  readonly costs: Float64Array;
  readonly solver: SolverScratch;
  best: Float64Array;
  start: Float64Array;
  turned: Float64Array;
  numeric: NumericJog | null;
  readonly baseFromFlange: Pose<"base", "flange">;
  readonly worldFromTcp: Pose<"world", "tcp">;
  readonly wanted: Pose<"world", "tcp">;
  readonly worldFromFlange: Pose<"world", "flange">;
  readonly baseFromTcp: Pose<"base", "tcp">;
  readonly baseFromWorld: Pose<"base", "world">;
  readonly tcpFromFlange: Pose<"tcp", "flange">;
  readonly linear: Vector3;
  readonly angular: Vector3;
  readonly masked: Vector3;
  readonly axis: Vector3;
  readonly turns: Vector3;
  readonly turn: Quaternion;
  /**
   * The last turn in place of the joints, this step's, and the wish it was for, so that one does not undo the other.
   * All 0 where the tip moved.
   */
  turnedLast: Float64Array;
  turnedNow: Float64Array;
  readonly turnedFor: Float64Array;
}
export const jogScratch = (): JogScratch => ({
  raw: new Float64Array(6 * MAX_BRANCHES),
  best: new Float64Array(6),
  start: new Float64Array(6),
  ahead: new Float64Array(6),
  turned: new Float64Array(6),
  arm: armScratch(),
  numeric: null,
  count: 0,
  costs: new Float64Array(MAX_BRANCHES),
  solver: solverScratch(),
  baseFromFlange: identity(),
  worldFromTcp: identity(),
  wanted: identity(),
  worldFromFlange: identity(),
  baseFromTcp: identity(),
  baseFromWorld: identity(),
  tcpFromFlange: identity(),
  linear: [0, 0, 0],
  angular: [0, 0, 0],
  masked: [0, 0, 0],
  axis: [0, 0, 0],
  turns: [0, 0, 0],
  turn: [0, 0, 0, 1],
  turnedLast: new Float64Array(6),
  turnedNow: new Float64Array(6),
  turnedFor: new Float64Array(6),
});

/** The largest joint speed of the step as a share of what that joint can do. */
export function speedLoad(robot: Robot, from: Float64Array, to: Float64Array, dt_s: number): number {
  let load = 0;
  for (let j = 0; j < to.length; j++)
    load = Math.max(load, Math.abs(to[j]! - from[j]!) / (robot.arm.joints[j]!.limits.speed_rad_s * dt_s));
  return load;
}

/** Rounding of limits given in degrees. */
const LIMIT_SLACK_RAD = 1e-9;
/** This near to a singularity [m, sine] the tip does not notice its joints being turned in place. */
export const ON_SINGULARITY = 1e-8;

/** First joint (from 1) that would leave its limits, or go further out of them than at `start`; 0 when none does. */
export function jointOutside(robot: Robot, angles: Float64Array, at: number, start: Float64Array): number {
  for (let j = 0; j < start.length; j++) {
    const { lower_rad, upper_rad } = robot.arm.joints[j]!.limits;
    const angle = angles[at + j]!;
    if (
      (angle > upper_rad + LIMIT_SLACK_RAD && angle > start[j]!) ||
      (angle < lower_rad - LIMIT_SLACK_RAD && angle < start[j]!)
    )
      return j + 1;
  }
  return 0;
}

/** That a joint (from 1) would leave its limits. */
export function nearestLimit(robot: Robot, q: Float64Array, joint: number, branch: Branch | undefined): Reach {
  const { lower_rad, upper_rad } = robot.arm.joints[joint - 1]!.limits;
  const wanted_rad = q[joint - 1]!;
  return {
    kind: "outside-limits",
    joint,
    wanted_rad,
    limit_rad: wanted_rad < lower_rad ? lower_rad : upper_rad,
    branch,
  };
}

/** A turn in place below this share of the joint speeds is rounding. */
export const MIN_TURN = 1e-3;
