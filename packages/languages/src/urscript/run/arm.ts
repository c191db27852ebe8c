import {
  branchOf,
  compose,
  flangePose,
  nearestSolution,
  solverScratch,
  type Branch,
  type Pose,
  type Robot,
} from "@twincell/core";
import { fromPose, matrixOf, sixOf, toPose } from "./frame.ts";
import type { PoseValue } from "./values.ts";
import { inverted, times, type Matrix } from "../../parser/index.ts";

/** Where the arm is sent, and what the controller works out about it. Poses count in the controller's base. */
export class ControllerArm {
  readonly robot: Robot;
  private readonly worldFromController: Matrix;
  private readonly controllerFromBase: Matrix;
  private readonly baseFromController: Pose<"base", "controller">;
  private readonly scratch = solverScratch();
  tcp: Matrix = matrixOf([0, 0, 0, 0, 0, 0]);
  /**
   * The last joint angles that are known, undefined where they cannot be worked out, and the poses of the flange since
   * then.
   */
  private settled: readonly number[] | undefined;
  private since: Matrix[] = [];

  constructor(robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    const baseFromController = fromPose(robot.baseFromVendorWorld);
    this.baseFromController = toPose<"base", "controller">(baseFromController);
    this.controllerFromBase = inverted(baseFromController);
    this.worldFromController = times(fromPose(worldFromBase), baseFromController);
    this.settled = robot.home_rad;
  }

  flangeAt(joints: readonly number[]): Matrix {
    return times(this.controllerFromBase, fromPose(flangePose(this.robot.arm, joints)));
  }
  /** The tool tip where the arm is sent. */
  tip(): Matrix {
    return times(this.since.at(-1) ?? this.flangeAt(this.settled!), this.tcp);
  }
  tipAt(joints: readonly number[]): Matrix {
    return times(this.flangeAt(joints), this.tcp);
  }
  world<Into extends string, From extends string>(pose: Matrix): Pose<Into, From> {
    return toPose(times(this.worldFromController, pose));
  }

  /**
   * The posture that each pose was reached in, one after the other, is worked out when somebody asks. Undefined where
   * it cannot be.
   */
  get joints(): readonly number[] | undefined {
    for (const flange of this.since)
      this.settled = this.settled === undefined ? undefined : this.solvedFor(flange, this.settled);
    if (this.settled !== undefined) this.since = [];
    return this.settled;
  }

  atJoints(joints: readonly number[]): void {
    this.settled = joints;
    this.since = [];
  }

  /** The tip is at that pose; the posture is the one nearest to where the arm was, or to `near`. */
  atPose(pose: PoseValue, near?: readonly number[]): void {
    const flange = times(matrixOf(pose.six), inverted(this.tcp));
    if (near !== undefined) {
      this.settled = near;
      this.since = [flange];
      return;
    }
    this.since.push(flange);
  }

  /** Joint angles for a pose of the tip, nearest to a posture. Undefined where they cannot be worked out. */
  solve(pose: PoseValue, near: readonly number[]): readonly number[] | undefined {
    return this.solvedFor(times(matrixOf(pose.six), inverted(this.tcp)), near);
  }

  /** Remembers where the arm is; the answer brings it back. */
  remember(): () => void {
    const { tcp, settled } = this;
    const since = [...this.since];
    return () => {
      this.tcp = tcp;
      this.settled = settled;
      this.since = [...since];
    };
  }

  branch(joints: readonly number[]): Branch | undefined {
    return branchOf(this.robot, joints);
  }

  private solvedFor(flange: Matrix, near: readonly number[]): readonly number[] | undefined {
    const q = new Float64Array(near.length);
    const baseFromFlange = compose(this.baseFromController, toPose<"controller", "flange">(flange));
    return nearestSolution(this.robot, baseFromFlange, near, q, this.scratch) ? [...q] : undefined;
  }

  /** Six numbers of a matrix. */
  six(matrix: Matrix): PoseValue {
    return { kind: "pose", six: sixOf(matrix) };
  }
}
