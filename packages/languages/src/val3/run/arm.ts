import { branchOf, flangePose, solveAll, type Branch, type Pose, type Robot } from "@twincell/core";
import { ShownAxes, armPoints } from "../../parser/index.ts";
import { fromPose, inverted, times, toPose, type Trsf } from "./trsf.ts";

/** Configuration words of a point. */
export interface Config {
  readonly shoulder: string;
  readonly elbow: string;
  readonly wrist: string;
}

const BORDER_MM = 0.01;
const BORDER_DEG = 5e-4;

export class ControllerArm {
  readonly robot: Robot;
  readonly axes: ShownAxes;
  private readonly baseFromWorld: Trsf;
  private readonly cellFromWorld: Trsf;
  joints_rad: readonly number[] | undefined;

  constructor(robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    this.axes = ShownAxes.of(robot, "val3")!;
    this.baseFromWorld = fromPose(robot.baseFromVendorWorld);
    this.cellFromWorld = times(fromPose(worldFromBase), this.baseFromWorld);
    this.joints_rad = robot.home_rad;
  }

  /** A pose of the controller's world in the cell. */
  cell<Into extends string, From extends string>(trsf: Trsf): Pose<Into, From> {
    return toPose(times(this.cellFromWorld, trsf));
  }

  /** The flange is there, as the words ask for it; where no posture does, in the nearest, and `fits` says so. */
  atFlange(flange: Trsf, config: Config): { readonly branch: Branch | undefined; readonly fits: boolean } {
    const { robot, joints_rad: near } = this;
    const reach = solveAll(robot, toPose(times(this.baseFromWorld, flange)), near === undefined ? {} : { near });
    if (reach.kind !== "reached") {
      this.joints_rad = undefined;
      return { branch: undefined, fits: true };
    }
    const all = reach.solutions.map(({ q_rad }) => [...q_rad]);
    const fitting = all.find(each => this.fits(each, config));
    const q = fitting ?? all[0]!;
    this.joints_rad = q;
    return { branch: branchOf(robot, q), fits: fitting !== undefined };
  }

  /** The flange in the world of the controller; undefined where nobody knows the joints. */
  flange(): Trsf | undefined {
    if (this.joints_rad === undefined) return undefined;
    return times(inverted(this.baseFromWorld), fromPose(flangePose(this.robot.arm, this.joints_rad)));
  }

  private fits(q: readonly number[], { shoulder, elbow, wrist }: Config): boolean {
    const shown = this.axes.degrees(q);
    const ahead_mm = 1000 * armPoints(this.robot, this.axes, q).ahead_m;
    const asked = (word: string, yes: string, no: string, value: number, border: number): boolean =>
      Math.abs(value) < border || (word !== yes && word !== no) || (word === yes) === value > 0;
    return (
      asked(shoulder, "righty", "lefty", ahead_mm, BORDER_MM) &&
      asked(elbow, "epositive", "enegative", shown[2]!, BORDER_DEG) &&
      asked(wrist, "wpositive", "wnegative", shown[4]!, BORDER_DEG)
    );
  }

  remember(): () => void {
    const { joints_rad } = this;
    return () => {
      this.joints_rad = joints_rad;
    };
  }
}
