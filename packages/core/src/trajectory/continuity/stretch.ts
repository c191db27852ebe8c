import { allBranches, solverScratch } from "../../kinematics/inverse.ts";
import { nearestSingularity } from "../../kinematics/singularity.ts";
import { LIMIT_SLACK_RAD } from "../../kinematics/turns.ts";
import type { Robot } from "../../model/robot.ts";
import { compose, identity, type Pose } from "../../spatial/pose.ts";
import { Follower } from "../follow.ts";
import { geometryScratch, posePoint, type PosePath } from "../geometry.ts";
import { HermitePath } from "../hermite-path.ts";
import { SHORTEST_M } from "../pose-paths.ts";
import { PATH_TOLERANCE_M } from "../run.ts";

/** Why a posture cannot be kept any further along a path. Joint counts from 1. */
export type Lost =
  | {
      readonly kind: "limit";
      readonly share: number;
      readonly joint: number;
      readonly wanted_rad: number;
      readonly limit_rad: number;
    }
  /** Joints would have to jump. `near`: what the arm is close to there, in words. */
  | { readonly kind: "singular"; readonly share: number; readonly near: string | undefined }
  | { readonly kind: "out-of-reach"; readonly share: number };

/** Between two postures that are looked at no joint moves by more than this [rad, m]. */
export const CONTINUITY_RAD = 0.1;
/** Places that are looked at are no farther apart than this [m], */
const LOOK_M = 0.05;
/** and when this part of the path is still too far for the joints, they jump. */
const SHORTEST_SHARE = 1 / 4096;
/**
 * Where a joint turns faster than this many radians per whole path, the path is laid out as the planner does it, to see
 * whether it can.
 */
const STEEP_RAD = 3;

/**
 * Keeps one posture along a TCP path in steps small enough that it cannot be mistaken for another one: a step that
 * moves a joint by more than `CONTINUITY_RAD` is halved. One instance per caller; it allocates only where a posture is
 * lost.
 */
export class StretchFollower {
  /** Of the last path: Σ max |Δq| / speed over its steps [s]. */
  seconds = 0;
  /** Of the last path: how far each joint went below and above where it began. */
  readonly below: Float64Array;
  readonly above: Float64Array;
  private readonly robot: Robot;
  private readonly follower: Follower;
  private readonly scratch = geometryScratch();
  private readonly tcp: Pose<"base", "tcp"> = identity();
  private readonly goal: Pose<"base", "flange"> = identity();
  private readonly trial: Float64Array;
  private readonly start: Float64Array;
  private readonly exact: HermitePath;
  private steep = false;

  constructor(robot: Robot, follower = new Follower(robot.arm)) {
    const n = robot.arm.joints.length;
    this.robot = robot;
    this.follower = follower;
    this.exact = new HermitePath(follower, PATH_TOLERANCE_M);
    this.below = new Float64Array(n);
    this.above = new Float64Array(n);
    this.trial = new Float64Array(n);
    this.start = new Float64Array(n);
  }

  /** Whether the last path goes so close by a singularity that only laying it out can tell. */
  get doubtful(): boolean {
    return this.steep;
  }

  /**
   * @param q       posture at the start of the path; receives the one at its end, or the last one that was kept.
   * @param within  whether leaving the joint limits loses the posture.
   */
  follow(path: PosePath, tcpFromFlange: Pose<"tcp", "flange">, q: Float64Array, within: boolean): Lost | undefined {
    const {
      trial,
      start,
      below,
      above,
      robot: {
        arm: { joints },
      },
    } = this;
    const n = q.length;
    const { length } = path;
    this.seconds = 0;
    this.steep = false;
    below.fill(0);
    above.fill(0);
    start.set(q);
    if (length < SHORTEST_M) return undefined;
    const least = length * SHORTEST_SHARE;
    let h = Math.min(length, LOOK_M);
    let steepest = 0;
    for (let s = 0; s < length; ) {
      const to = length - s < h + least ? length : s + h;
      posePoint(path, to, this.tcp, this.scratch);
      compose(this.tcp, tcpFromFlange, this.goal);
      trial.set(q);
      const met = this.follower.meet(this.goal, trial);
      let longest = met ? 0 : Number.POSITIVE_INFINITY;
      let seconds = 0;
      for (let j = 0; j < n && met; j++) {
        const way = Math.abs(trial[j]! - q[j]!);
        if (!(way <= longest)) longest = way;
        const time_s = way / joints[j]!.limits.speed_rad_s;
        if (time_s > seconds) seconds = time_s;
      }
      if (!(longest <= CONTINUITY_RAD)) {
        h = (to - s) / 2;
        if (h < least) return this.lost(q, s / length);
        continue;
      }
      steepest = Math.max(steepest, (longest * length) / (to - s));
      s = to;
      this.seconds += seconds;
      for (let j = 0; j < n; j++) {
        const gone = trial[j]! - start[j]!;
        if (gone < below[j]!) below[j] = gone;
        else if (gone > above[j]!) above[j] = gone;
        const { lower_rad, upper_rad } = joints[j]!.limits;
        const over = trial[j]! > upper_rad + LIMIT_SLACK_RAD;
        if (within && (over || trial[j]! < lower_rad - LIMIT_SLACK_RAD))
          return {
            kind: "limit",
            share: s / length,
            joint: j + 1,
            wanted_rad: trial[j]!,
            limit_rad: over ? upper_rad : lower_rad,
          };
      }
      q.set(trial);
      if (longest < CONTINUITY_RAD / 4) h = Math.min(2 * h, LOOK_M);
    }
    this.steep = steepest > STEEP_RAD;
    return undefined;
  }

  /**
   * Whether the planner gets along the path that was followed last, where that is in doubt. @param q  posture at its
   * start.
   */
  confirm(path: PosePath, tcpFromFlange: Pose<"tcp", "flange">, q: ArrayLike<number>): Lost | undefined {
    if (!this.steep) return undefined;
    this.trial.set(q);
    this.exact.clear();
    const stop = this.exact.addPoses(path, tcpFromFlange, 0, path.length, this.trial, 0, 0);
    return stop === undefined
      ? undefined
      : { kind: "singular", share: stop.s / path.length, near: nearestSingularity(this.robot, this.trial)?.sentence };
  }

  /** Whether another posture that is the same up to whole turns keeps inside its limits where the last one went. */
  fits(q: Float64Array, at: number): boolean {
    const joints = this.robot.arm.joints;
    for (let j = 0; j < joints.length; j++) {
      const { lower_rad, upper_rad } = joints[j]!.limits;
      if (
        q[at + j]! + this.below[j]! < lower_rad - LIMIT_SLACK_RAD ||
        q[at + j]! + this.above[j]! > upper_rad + LIMIT_SLACK_RAD
      )
        return false;
    }
    return true;
  }

  private lost(q: Float64Array, share: number): Lost {
    // An arm without closed form cannot tell the two apart: the place was not met.
    if (this.robot.family.kind === "general" || allBranches(this.robot, this.goal, q, solverScratch()).length === 0)
      return { kind: "out-of-reach", share };
    return { kind: "singular", share, near: nearestSingularity(this.robot, q)?.sentence };
  }
}
