import { allBranches, type Pose, type Robot } from "@twincell/core";
import { ShownAxes } from "../../parser/index.ts";

const DEG = 180 / Math.PI;
/** What the rounding of a written position may add to an axis at its limit. */
const LIMIT_SLACK_RAD = 1e-5;
/** Near 0° the controller takes either sign of an axis for its Turn bit. */
const TURN_SLACK_DEG = 2;
/**
 * This close to a border of Status either side is right [m, °]: next to it, and as far as the rounding of a written
 * position moves a stretched arm.
 */
export const STATUS_SLACK = { exact: 1e-6, written: 1e-3 } as const;

/** Axis values of a robot as its controller shows them, and what Status and Turn say of them. */
export class Axes {
  private readonly robot: Robot;
  private readonly shown: ShownAxes;
  readonly count: number;

  private constructor(robot: Robot, shown: ShownAxes) {
    this.robot = robot;
    this.shown = shown;
    this.count = robot.arm.joints.length;
  }

  /** Undefined for a robot whose axes are not known here. */
  static of(robot: Robot): Axes | undefined {
    const shown = ShownAxes.of(robot, "krl");
    return shown === undefined ? undefined : new Axes(robot, shown);
  }

  radians(axes_deg: readonly number[]): number[] {
    return this.shown.radians(axes_deg);
  }

  degrees(q_rad: ArrayLike<number>): number[] {
    return this.shown.degrees(q_rad);
  }

  /** Axis values that reach a pose within the limits, every turn of every axis. */
  reaching(baseFromFlange: Pose<"base", "flange">, near_deg: readonly number[]): number[][] {
    const found: number[][] = [];
    const { joints } = this.robot.arm;
    for (const q of allBranches(this.robot, baseFromFlange, this.radians(near_deg))) {
      const choices = joints.map(({ limits }, i) =>
        [q[i]! - 2 * Math.PI, q[i]!, q[i]! + 2 * Math.PI].filter(
          x => x >= limits.lower_rad - LIMIT_SLACK_RAD && x <= limits.upper_rad + LIMIT_SLACK_RAD,
        ),
      );
      let copies: number[][] = [[]];
      for (const choice of choices) copies = copies.flatMap(copy => choice.map(x => [...copy, x]));
      for (const copy of copies) found.push(this.degrees(copy));
    }
    return found;
  }

  /**
   * Whether axis values have that Status. Bit 0: the wrist centre is behind axis 1. Bit 1: axis 3 is bent further than
   * where the wrist centre, axis 3 and axis 2 lie on a line. Bit 2: axis 5 is negative.
   */
  hasStatus(axes_deg: readonly number[], status: number, slack: number = STATUS_SLACK.exact): boolean {
    const family = this.robot.family;
    if (family.kind !== "ortho-parallel") return true;
    const { a1_m, a2_m, c2_m, c3_m } = family;
    const a2 = axes_deg[1]! / DEG;
    const a3 = axes_deg[2]! / DEG;
    const a5 = ((((axes_deg[4]! + 180) % 360) + 360) % 360) - 180;
    // Level is A2 = 0; the forearm goes on from there, its wrist off to the side by a2.
    const ahead = a1_m + c2_m * Math.cos(a2) + c3_m * Math.cos(a2 + a3) - a2_m * Math.sin(a2 + a3);
    const bent = c3_m * Math.sin(a3) + a2_m * Math.cos(a3);
    const bit = (value: number, set: boolean, n: number): boolean =>
      Math.abs(value) < slack || set === ((status >> n) % 2 === 1);
    return bit(ahead, ahead < 0, 0) && bit(bent, bent > 0, 1) && bit(a5, a5 < 0, 2);
  }

  /** Turn: bit i - 1 is set when A_i is negative. */
  hasTurn(axes_deg: readonly number[], turn: number): boolean {
    return axes_deg.every((value, i) => Math.abs(value) < TURN_SLACK_DEG || value < 0 === ((turn >> i) % 2 === 1));
  }
}

export const travel = (a: readonly number[], b: readonly number[]): number =>
  a.reduce((sum, value, i) => sum + Math.abs(value - b[i]!), 0);
