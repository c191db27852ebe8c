import { branchOf, flangePose, solveAll, travel, type Branch, type Pose, type Robot } from "@twincell/core";
import { ShownAxes, armPoints } from "../shown-axes.ts";
import { NOWHERE, asPose, back, ofPose, on, type Rigid } from "./rigid.ts";
import type { Posture } from "./values.ts";

/** How a language counts the arm of its robots. */
export interface Upright {
  /** Id of the language, whose vendor section says what axes show. */
  readonly language: string;
  /** 1 where axis 2 leans the upper arm forwards as what it shows grows, else -1. */
  readonly leansForward: 1 | -1;
}

/** Where the arm is sent, and what the controller works out about it. Places count from the base of the robot. */
export class UprightArm {
  readonly robot: Robot;
  tool: Rigid = NOWHERE;
  private readonly worldFromBase: Rigid;
  private readonly axes: ShownAxes;
  private readonly leansForward: 1 | -1;
  /** The last joint angles that were known [rad]. */
  private near: readonly number[];
  private flange: Rigid;
  /** The robot went where nobody here knows. */
  isLost = false;

  constructor(robot: Robot, { language, leansForward }: Upright, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    this.axes = ShownAxes.of(robot, language)!;
    this.leansForward = leansForward;
    this.worldFromBase = ofPose(worldFromBase);
    this.near = robot.home_rad;
    this.flange = ofPose(flangePose(robot.arm, robot.home_rad));
  }

  /** Joint angles [rad] of what the axes show. */
  inRadians(deg: readonly number[]): number[] {
    return this.axes.radians(deg);
  }

  /** The tool, from the base. */
  here(): Rigid {
    return on(this.flange, this.tool);
  }
  atAngles(deg: readonly number[]): Rigid {
    return on(ofPose(flangePose(this.robot.arm, this.inRadians(deg))), this.tool);
  }
  inWorld<Into extends string, From extends string>(place: Rigid): Pose<Into, From> {
    return asPose(on(this.worldFromBase, place));
  }

  goneToAngles(deg: readonly number[]): void {
    this.isLost = false;
    this.near = this.inRadians(deg);
    this.flange = ofPose(flangePose(this.robot.arm, this.near));
  }

  goneTo(place: Rigid): void {
    this.isLost = false;
    this.flange = on(place, back(this.tool));
  }

  /**
   * The posture at a place; what is left open is as near as possible to where the arm was. Undefined when there is
   * none.
   */
  branchAt(place: Rigid, configuration: Posture): Branch | undefined {
    const reach = solveAll(this.robot, asPose<"base", "flange">(on(place, back(this.tool))), { near: this.near });
    if (reach.kind !== "reached") return undefined;
    const found = reach.solutions
      .map(({ q_rad }) => [...q_rad])
      .filter(q => this.fits(q, configuration))
      .sort((a, b) => travel(a, this.near) - travel(b, this.near))[0];
    if (found === undefined) return undefined;
    this.near = found;
    return branchOf(this.robot, found);
  }

  private fits(q_rad: readonly number[], { front, up, bent, wrist }: Posture): boolean {
    const { ahead_m, folded } = armPoints(this.robot, this.axes, q_rad, this.leansForward);
    const isFront = ahead_m >= 0;
    const isBent = folded > 0;
    return (
      (front === undefined || front === isFront) &&
      (bent === undefined || bent === isBent) &&
      (up === undefined || up === (isFront === isBent)) &&
      (wrist === undefined || wrist === this.axes.degrees(q_rad)[4]! > 0)
    );
  }

  /** Remembers where the arm is; the answer brings it back. */
  remember(): () => void {
    const { tool, near, flange, isLost } = this;
    return () => {
      this.isLost = isLost;
      this.tool = tool;
      this.near = near;
      this.flange = flange;
    };
  }
}
