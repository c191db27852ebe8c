import { branchOf, flangePose, solveAll, travel, type Branch, type Pose, type Robot } from "@twincell/core";
import { NOWHERE, asPose, back, ofPose, on, type Rigid } from "./rigid.ts";
import type { Posture } from "./values.ts";

/**
 * What a controller knows of an upright arm with six joints: how far axis 2 is in front of axis 1, the lengths of the
 * upper arm and of the forearm, how far the wrist is in front of the forearm's line; how its joints lean the upper arm
 * forwards from upright and fold the forearm forwards from the upper arm [°]; and the sign of joint 5.
 */
export interface Upright {
  readonly ahead_mm: number;
  readonly upper_mm: number;
  readonly fore_mm: number;
  readonly offset_mm: number;
  readonly lean: (joints_deg: readonly number[]) => number;
  readonly fold: (joints_deg: readonly number[]) => number;
}

const DEG = Math.PI / 180;
export const inRadians = (deg: readonly number[]): number[] => deg.map(angle => angle * DEG);

/** Where the arm is sent, and what the controller works out about it. Places count from the base of the robot. */
export class UprightArm {
  readonly robot: Robot;
  tool: Rigid = NOWHERE;
  private readonly worldFromBase: Rigid;
  private readonly upright: Upright;
  /** The last joint angles that were known [rad]. */
  private near: readonly number[];
  private flange: Rigid;
  /** The robot went where nobody here knows. */
  isLost = false;

  constructor(robot: Robot, upright: Upright, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    this.upright = upright;
    this.worldFromBase = ofPose(worldFromBase);
    this.near = robot.home_rad;
    this.flange = ofPose(flangePose(robot.arm, robot.home_rad));
  }

  /** The tool, from the base. */
  here(): Rigid {
    return on(this.flange, this.tool);
  }
  atAngles(deg: readonly number[]): Rigid {
    return on(ofPose(flangePose(this.robot.arm, inRadians(deg))), this.tool);
  }
  inWorld<Into extends string, From extends string>(place: Rigid): Pose<Into, From> {
    return asPose(on(this.worldFromBase, place));
  }

  goneToAngles(deg: readonly number[]): void {
    this.isLost = false;
    this.near = inRadians(deg);
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

  /**
   *   reach = ahead + upper · sin lean + fore · sin(lean + fold) + offset · cos(lean + fold)
   *   bend  = fold + atan2(offset, fore)
   */
  private fits(q_rad: readonly number[], { front, up, bent, wrist }: Posture): boolean {
    const { ahead_mm, upper_mm, fore_mm, offset_mm, lean, fold } = this.upright;
    const deg = q_rad.map(angle => angle / DEG);
    const upperArm = lean(deg) * DEG;
    const forearm = upperArm + fold(deg) * DEG;
    const isFront =
      ahead_mm + upper_mm * Math.sin(upperArm) + fore_mm * Math.sin(forearm) + offset_mm * Math.cos(forearm) >= 0;
    const isBent = Math.sin(fold(deg) * DEG + Math.atan2(offset_mm, fore_mm)) > 0;
    return (
      (front === undefined || front === isFront) &&
      (bent === undefined || bent === isBent) &&
      (up === undefined || up === (isFront === isBent)) &&
      (wrist === undefined || wrist === deg[4]! > 0)
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
