import {
  branchOf,
  compose,
  flangePose,
  inverse,
  solveAll,
  travel,
  type Branch,
  type Pose,
  type Robot,
} from "@twincell/core";
import { ShownAxes, armPoints, inverted, times, type Matrix } from "../../parser/index.ts";
import { NULL, fromPose, toPose } from "./frame.ts";

/** Words that name a posture of the next joint motion. */
export interface Posture {
  readonly arm?: "lefty" | "righty";
  readonly elbow?: "above" | "below";
  readonly wrist?: "uwrist" | "dwrist";
}

/** Where the arm is sent, and what the controller works out about it. Places count from the base of the robot. */
export class ControllerArm {
  readonly robot: Robot;
  readonly worldFromBase: Matrix;
  tool: Matrix = NULL;
  base: Matrix = NULL;
  /** The last joint angles that were known [rad]. */
  private near: readonly number[];
  private flange: Matrix;
  readonly axes: ShownAxes;
  /** Where the arm is hangs on what only the controller knows. */
  isLost = false;

  constructor(robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    this.worldFromBase = fromPose(worldFromBase);
    this.axes = ShownAxes.of(robot, "kawasaki-as")!;
    this.near = robot.home_rad;
    this.flange = fromPose(flangePose(robot.arm, robot.home_rad));
  }

  /** HERE: the tool in the base that programs count from. */
  here(): Matrix {
    return times(inverted(this.base), times(this.flange, this.tool));
  }
  placeOf(deg: readonly number[]): Matrix {
    return times(inverted(this.base), times(fromPose(flangePose(this.robot.arm, this.axes.radians(deg))), this.tool));
  }
  inWorld<Into extends string, From extends string>(place: Matrix): Pose<Into, From> {
    return toPose(times(this.worldFromBase, this.base === NULL ? place : times(this.base, place)));
  }

  atJoints(deg: readonly number[]): void {
    this.isLost = false;
    this.near = this.axes.radians(deg);
    this.flange = fromPose(flangePose(this.robot.arm, this.near));
  }

  atPlace(place: Matrix): void {
    this.isLost = false;
    const tip = this.base === NULL ? place : times(this.base, place);
    this.flange = this.tool === NULL ? tip : times(tip, inverted(this.tool));
  }

  /**
   * The posture that words ask for at a place; what they leave open is as near as possible to where the arm was.
   * Undefined when there is none.
   */
  branchAt(place: Matrix, words: Posture): Branch | undefined {
    const flange = times(times(this.base, place), inverted(this.tool));
    const reach = solveAll(
      this.robot,
      compose(inverse(toPose<"base", "base">(NULL)), toPose<"base", "flange">(flange)),
      { near: this.near },
    );
    if (reach.kind !== "reached") return undefined;
    let best: readonly number[] | undefined;
    let least = Infinity;
    for (const { q_rad } of reach.solutions) {
      const way = travel(q_rad, this.near);
      if (way < least && this.fits(q_rad, words)) {
        least = way;
        best = [...q_rad];
      }
    }
    if (best === undefined) return undefined;
    this.near = best;
    return branchOf(this.robot, best);
  }

  /**
   * RIGHTY: the wrist is in front of the axis of JT1. ABOVE: the elbow is above the line from shoulder to wrist.
   * UWRIST: JT5 > 0.
   */
  private fits(q: ArrayLike<number>, { arm, elbow, wrist }: Posture): boolean {
    const { ahead_m, folded } = armPoints(this.robot, this.axes, q);
    const jt5 = this.axes.degrees(q)[4]!;
    const isFront = ahead_m >= 0;
    const isAbove = isFront === folded > 0;
    return (
      (arm === undefined || (arm === "righty") === isFront) &&
      (elbow === undefined || (elbow === "above") === isAbove) &&
      (wrist === undefined || (wrist === "uwrist") === jt5 > 0)
    );
  }

  /** Remembers where the arm is; the answer brings it back. */
  remember(): () => void {
    const { tool, base, near, flange, isLost } = this;
    return () => {
      this.tool = tool;
      this.base = base;
      this.near = near;
      this.flange = flange;
      this.isLost = isLost;
    };
  }
}
