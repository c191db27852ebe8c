import { branchOf, flangePose, solveAll, type Branch, type Pose, type Robot } from "@twincell/core";
import { ShownAxes, armPoints } from "../../parser/index.ts";
import type { Config } from "../read/listing.ts";
import { fromPose, inverted, times, toPose, type Matrix } from "./matrix.ts";

/** This close to a border of a flag either letter is right. */
const BORDER_MM = 0.01;
const BORDER_DEG = 0.001;

/** Where the arm is sent. */
export class ControllerArm {
  readonly robot: Robot;
  private readonly axes: ShownAxes;
  private readonly baseFromWorld: Matrix;
  private readonly cellFromController: Matrix;
  joints_rad: readonly number[] | undefined;
  private known: Matrix | undefined;
  /** The robot went where nobody here knows. */
  isLost = false;

  constructor(robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    this.axes = ShownAxes.of(robot, "fanuc-ls")!;
    this.baseFromWorld = fromPose(robot.baseFromVendorWorld);
    this.cellFromController = times(fromPose(worldFromBase), this.baseFromWorld);
    this.joints_rad = robot.home_rad;
  }

  /** A pose of the controller's world in the cell. */
  cell<Into extends string, From extends string>(pose: Matrix): Pose<Into, From> {
    return toPose(times(this.cellFromController, pose));
  }

  /** The flange in the controller's world. */
  get flange(): Matrix {
    return (this.known ??= times(
      inverted(this.baseFromWorld),
      fromPose(flangePose(this.robot.arm, this.joints_rad ?? this.robot.home_rad)),
    ));
  }

  /** From here on nobody knows where the robot stands. */
  lose(): void {
    this.isLost = true;
  }

  atShown(shown_deg: readonly number[]): readonly number[] {
    this.isLost = false;
    const own = this.axes.radians(shown_deg);
    this.joints_rad = own;
    this.known = undefined;
    return own;
  }

  shown(): readonly number[] {
    return this.axes.degrees(this.joints_rad ?? this.robot.home_rad);
  }

  /**
   * The flange is there, in the posture that the configuration asks for, or in the nearest where it asks for none that
   * exists. `turned` says that the posture is another turn of an axis than the nearest, `fits` that its letters are
   * those asked for.
   */
  atFlange(
    flange: Matrix,
    config: Config | undefined,
  ): {
    readonly branch: Branch | undefined;
    readonly q: readonly number[] | undefined;
    readonly turned: boolean;
    readonly fits: boolean;
  } {
    const { robot, joints_rad: near } = this;
    this.isLost = false;
    const reach = solveAll(robot, toPose(times(this.baseFromWorld, flange)), near === undefined ? {} : { near });
    this.known = flange;
    if (reach.kind !== "reached") {
      this.joints_rad = undefined;
      return { branch: undefined, q: undefined, turned: false, fits: true };
    }
    const all = reach.solutions.map(({ q_rad }) => [...q_rad]);
    const fitting = config === undefined ? all : all.filter(q => this.hasFlags(q, config));
    const nearest = fitting[0] ?? all[0]!;
    const exact =
      config === undefined ? nearest : (fitting.find(q => hasTurns(this.axes.degrees(q), config)) ?? nearest);
    this.joints_rad = exact;
    return { branch: branchOf(robot, exact), q: exact, turned: exact !== nearest, fits: fitting.length > 0 };
  }

  /**
   * Flags read off the links: wrist in front of axis 1, elbow above the line from axis 2 to the wrist, axis 5 not below
   * zero.
   */
  hasFlags(q: readonly number[], { flip, up, toward }: Config): boolean {
    const { shoulder, wrist, ahead_m, folded } = armPoints(this.robot, this.axes, q);
    const ahead_mm = 1000 * ahead_m;
    // How far the elbow is from the line between axis 2 and the wrist, above it as the arm faces.
    const apart_m = Math.hypot(wrist[0] - shoulder[0], wrist[1] - shoulder[1], wrist[2] - shoulder[2]);
    const above_mm = ((1000 * folded) / apart_m) * (ahead_m >= 0 ? 1 : -1);
    const bend = this.axes.degrees(q)[4]!;
    return (
      (Math.abs(ahead_mm) < BORDER_MM || ahead_mm >= 0 === toward) &&
      (Math.abs(above_mm) < BORDER_MM || above_mm > 0 === up) &&
      (Math.abs(bend) < BORDER_DEG || bend > 0 === flip)
    );
  }

  remember(): () => void {
    const { joints_rad, known, isLost } = this;
    return () => {
      this.isLost = isLost;
      this.joints_rad = joints_rad;
      this.known = known;
    };
  }
}

/** Turn 0 is within half a turn of zero, 1 and −1 the turns beside it; near a border either is right. */
const hasTurns = (axes_deg: readonly number[], { turns }: Config): boolean =>
  [axes_deg[0]!, axes_deg[3]!, axes_deg[5]!].every((deg, i) => {
    const from = turns[i]! * 360 - 180;
    return deg >= from - 2 * BORDER_DEG && deg <= from + 360 + 2 * BORDER_DEG;
  });
