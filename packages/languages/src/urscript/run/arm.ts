import { branchOf, compose, flangePose, inverse, solveAll, travel, type Branch, type Pose, type Robot } from "@twincell/core";
import { BASE_FROM_CONTROLLER, fromPose, inverted, matrixOf, sixOf, times, toPose, type Matrix } from "./frame.ts";
import type { PoseValue } from "./values.ts";

/** Where the arm is sent, and what the controller works out about it. Poses count in the controller's base. */
export class ControllerArm {
  readonly robot: Robot;
  private readonly worldFromController: Matrix;
  tcp: Matrix = matrixOf([0, 0, 0, 0, 0, 0]);
  /** Unknown after a pose whose joint angles are not solved here. */
  joints: readonly number[] | undefined;
  private flange: Matrix;

  constructor(robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    this.worldFromController = times(fromPose(worldFromBase), BASE_FROM_CONTROLLER);
    this.joints = robot.home_rad;
    this.flange = this.flangeAt(robot.home_rad);
  }

  flangeAt(joints: readonly number[]): Matrix { return times(inverted(BASE_FROM_CONTROLLER), fromPose(flangePose(this.robot.arm, joints))); }
  /** The tool tip where the arm is sent. */
  tip(): Matrix { return times(this.flange, this.tcp); }
  tipAt(joints: readonly number[]): Matrix { return times(this.flangeAt(joints), this.tcp); }
  world<Into extends string, From extends string>(pose: Matrix): Pose<Into, From> { return toPose(times(this.worldFromController, pose)); }

  atJoints(joints: readonly number[]): void {
    this.joints = joints;
    this.flange = this.flangeAt(joints);
  }

  /** The tip is at that pose; the posture is the one nearest to where the arm was. */
  atPose(pose: PoseValue, near: readonly number[] | undefined = this.joints): void {
    this.flange = times(matrixOf(pose.six), inverted(this.tcp));
    this.joints = near === undefined ? undefined : this.solved(near);
  }

  /** Joint angles for a pose of the tip, nearest to a posture. Undefined where they cannot be worked out. */
  solve(pose: PoseValue, near: readonly number[]): readonly number[] | undefined {
    return this.solvedFor(times(matrixOf(pose.six), inverted(this.tcp)), near);
  }

  /** Remembers where the arm is; the answer brings it back. */
  remember(): () => void {
    const { tcp, joints, flange } = this;
    return () => { this.tcp = tcp; this.joints = joints; this.flange = flange; };
  }

  branch(joints: readonly number[]): Branch | undefined { return branchOf(this.robot, joints); }

  private solved(near: readonly number[]): readonly number[] | undefined { return this.solvedFor(this.flange, near); }

  private solvedFor(flange: Matrix, near: readonly number[]): readonly number[] | undefined {
    const reach = solveAll(this.robot, compose(inverse(toPose<"controller", "base">(inverted(BASE_FROM_CONTROLLER))), toPose<"controller", "flange">(flange)), { near });
    if (reach.kind !== "reached") return undefined;
    let best: readonly number[] | undefined, least = Infinity;
    for (const { q_rad } of reach.solutions) {
      const way = travel(q_rad, near);
      if (way < least) { least = way; best = [...q_rad]; }
    }
    return best;
  }

  /** Six numbers of a matrix. */
  six(matrix: Matrix): PoseValue { return { kind: "pose", six: sixOf(matrix) }; }
}
