import { branchOf, flangePose, type Branch, type Pose, type Robot } from "@twincell/core";
import { ShownAxes } from "../../parser/index.ts";
import { octant, solved, type Confdata } from "./configuration.ts";
import { NOTHING, fromPose, times, toPose, type Frame } from "./frame.ts";

/**
 * Where the arm is sent. The controller counts from the base of the robot; its joints are shown in degrees.
 */
export class ControllerArm {
  readonly robot: Robot;
  readonly axes: ShownAxes;
  private readonly worldFromBase: Frame;
  /** Worked out when it is asked for. */
  private known: Frame | undefined;
  tool: Frame = NOTHING;
  /** Unknown after a pose whose joint angles are not solved here. */
  joints_deg: readonly number[] | undefined;

  constructor(robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    this.worldFromBase = fromPose(worldFromBase);
    this.axes = ShownAxes.of(robot, "rapid")!;
    this.joints_deg = this.axes.degrees(robot.home_rad);
  }

  get flange(): Frame {
    return (this.known ??= this.flangeAt(this.joints_deg!));
  }

  world<Into extends string, From extends string>(base: Frame): Pose<Into, From> {
    return toPose(times(this.worldFromBase, base));
  }
  flangeAt(joints_deg: readonly number[]): Frame {
    return fromPose(flangePose(this.robot.arm, this.axes.radians(joints_deg)));
  }

  atJoints(joints_deg: readonly number[]): void {
    this.joints_deg = joints_deg;
    this.known = undefined;
  }

  /**
   * The flange is there, in the configuration that is asked for or else in the nearest posture. Answers with the
   * branch, where it has a name.
   */
  atFlange(flange: Frame, conf: Confdata | undefined): Branch | undefined {
    const near = this.joints_deg === undefined ? undefined : this.axes.radians(this.joints_deg);
    const q = solved(this.robot, this.axes, toPose(flange), near, conf);
    this.known = flange;
    this.joints_deg = q === undefined ? undefined : this.axes.degrees(q);
    return q === undefined ? undefined : branchOf(this.robot, q);
  }

  configuration(): Confdata {
    const { joints_deg } = this;
    if (joints_deg === undefined) return [0, 0, 0, 0];
    const quarter = (joint: number): number => Math.floor(joints_deg[joint]! / 90);
    return [quarter(0), quarter(3), quarter(5), octant(this.robot, this.axes, this.axes.radians(joints_deg))];
  }

  /** Remembers where the arm is; the answer brings it back. */
  remember(): () => void {
    const { known, tool, joints_deg } = this;
    return () => {
      this.known = known;
      this.tool = tool;
      this.joints_deg = joints_deg;
    };
  }
}
