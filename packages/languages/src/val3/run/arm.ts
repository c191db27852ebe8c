import {
  branchOf,
  flangePose,
  identity,
  linkPoses,
  solveAll,
  type Branch,
  type Pose,
  type Robot,
} from "@twincell/core";
import { fromPose, inverted, times, toPose, type Trsf } from "./trsf.ts";

/** Configuration words of a point. */
export interface Config {
  readonly shoulder: string;
  readonly elbow: string;
  readonly wrist: string;
}

/**
 * Where the controllers of these robots count from: the height of axis 2. Their joints are degrees from upright, as
 * here.
 */
const WORLDS: Readonly<Record<string, Trsf>> = { staubli_rx160: { mm: [0, 0, 550], wxyz: [1, 0, 0, 0] } };
export const hasWorld = (robot: Robot): boolean => Object.hasOwn(WORLDS, robot.id);

const BORDER_MM = 0.01;
const BORDER_RAD = 1e-5;

export class ControllerArm {
  readonly robot: Robot;
  private readonly baseFromWorld: Trsf;
  private readonly cellFromWorld: Trsf;
  joints_rad: readonly number[] | undefined;

  constructor(robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    this.baseFromWorld = WORLDS[robot.id]!;
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
    const links = Array.from({ length: 7 }, () => identity<"base", "link">());
    linkPoses(this.robot.arm, q, links);
    const [x, y] = links[5]!.position;
    const ahead_mm = 1000 * (x * Math.cos(q[0]!) + y * Math.sin(q[0]!));
    const asked = (word: string, yes: string, no: string, value: number, border: number): boolean =>
      Math.abs(value) < border || (word !== yes && word !== no) || (word === yes) === value > 0;
    return (
      asked(shoulder, "righty", "lefty", ahead_mm, BORDER_MM) &&
      asked(elbow, "epositive", "enegative", q[2]!, BORDER_RAD) &&
      asked(wrist, "wpositive", "wnegative", q[4]!, BORDER_RAD)
    );
  }

  remember(): () => void {
    const { joints_rad } = this;
    return () => {
      this.joints_rad = joints_rad;
    };
  }
}
