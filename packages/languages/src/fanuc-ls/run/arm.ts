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
import type { Config } from "../read/listing.ts";
import { fromPose, inverted, times, toPose, type Matrix } from "./matrix.ts";

/**
 * What the pendant of a robot shows: of the arm's joints in degrees, and from where it counts. The forearm is shown
 * against the horizon, so that joint 3 is what is shown and what joint 2 is bent forward besides. Positions count from
 * where the axes of joints 1 and 2 would meet.
 */
interface Pendant {
  readonly forearmFollows: boolean;
  readonly zero_mm: readonly [number, number, number];
}
const PENDANTS: Readonly<Record<string, Pendant>> = {
  fanuc_lrmate200id: { forearmFollows: true, zero_mm: [0, 0, 330] },
};
export const hasPendant = (robot: Robot): boolean => Object.hasOwn(PENDANTS, robot.id);

const DEG = 180 / Math.PI;
/** This close to a border of a flag either letter is right. */
const BORDER_MM = 0.01;
const BORDER_DEG = 0.001;

/** Where the arm is sent. */
export class ControllerArm {
  readonly robot: Robot;
  private readonly pendant: Pendant;
  private readonly baseFromWorld: Matrix;
  private readonly cellFromController: Matrix;
  joints_rad: readonly number[] | undefined;
  private known: Matrix | undefined;
  /** The robot went where nobody here knows. */
  isLost = false;

  constructor(robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    this.pendant = PENDANTS[robot.id]!;
    this.baseFromWorld = {
      mm: this.pendant.zero_mm,
      rows: [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ],
    };
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
    const own = shown_deg.map(
      (angle, i) => (i === 2 && this.pendant.forearmFollows ? angle + shown_deg[1]! : angle) / DEG,
    );
    this.joints_rad = own;
    this.known = undefined;
    return own;
  }

  shown(): readonly number[] {
    const own = (this.joints_rad ?? this.robot.home_rad).map(angle => angle * DEG);
    return own.map((angle, i) => (i === 2 && this.pendant.forearmFollows ? angle - own[1]! : angle));
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
    const exact = config === undefined ? nearest : (fitting.find(q => hasTurns(q, config)) ?? nearest);
    this.joints_rad = exact;
    return { branch: branchOf(robot, exact), q: exact, turned: exact !== nearest, fits: fitting.length > 0 };
  }

  /**
   * Flags read off the links: wrist in front of axis 1, elbow above the line from axis 2 to the wrist, axis 5 not below
   * zero.
   */
  hasFlags(q: readonly number[], { flip, up, toward }: Config): boolean {
    const links = Array.from({ length: 7 }, () => identity<"base", "link">());
    linkPoses(this.robot.arm, q, links);
    const c = Math.cos(q[0]!);
    const s = Math.sin(q[0]!);
    const plane = (i: number): readonly [number, number] => {
      const [x, y, z] = links[i]!.position;
      return [(x * c + y * s) * 1000, z * 1000];
    };
    const shoulder = plane(2);
    const elbow = plane(3);
    const wrist = plane(5);
    const ahead = wrist[0] >= 0;
    const above =
      (((wrist[0] - shoulder[0]) * (elbow[1] - shoulder[1]) - (wrist[1] - shoulder[1]) * (elbow[0] - shoulder[0])) /
        Math.hypot(wrist[0] - shoulder[0], wrist[1] - shoulder[1])) *
      (ahead ? 1 : -1);
    const bend = q[4]! * DEG;
    return (
      (Math.abs(wrist[0]) < BORDER_MM || ahead === toward) &&
      (Math.abs(above) < BORDER_MM || above > 0 === up) &&
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
const hasTurns = (q: readonly number[], { turns }: Config): boolean =>
  [q[0]!, q[3]!, q[5]!].every((angle, i) => {
    const from = turns[i]! * 360 - 180;
    const deg = angle * DEG;
    return deg >= from - 2 * BORDER_DEG && deg <= from + 360 + 2 * BORDER_DEG;
  });
