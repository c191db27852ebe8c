import {
  branchOf,
  identity,
  linkPoses,
  rotate,
  sectionForLanguage,
  type Branch,
  type Robot,
  type Vector3,
  type VendorSection,
} from "@twincell/core";

const DEG = 180 / Math.PI;

/**
 * Axis values as the controller of a robot shows them, read off its vendor section for those who execute a text. It
 * computes by itself, axis after axis, and shares nothing with what the writers use: fixtures/vendor/axes.json holds
 * both.
 */
export class ShownAxes {
  private readonly section: VendorSection;

  private constructor(section: VendorSection) {
    this.section = section;
  }

  /** Undefined for a robot whose controllers do not run that language. */
  static of(robot: Robot, language: string): ShownAxes | undefined {
    const section = sectionForLanguage(robot, language);
    return section === undefined ? undefined : new ShownAxes(section);
  }

  /** What the other axes add to what one shows, by what those show. */
  private added(axis: number, shown_deg: ArrayLike<number>): number {
    const { couplings } = this.section;
    if (couplings === undefined) return 0;
    let sum = 0;
    for (const each of couplings) if (each.axis === axis + 1) sum += each.factor * shown_deg[each.with - 1]!;
    return sum;
  }

  /** Joint angles of shown values. */
  radians(shown_deg: readonly number[]): number[] {
    return this.section.axes.map(
      ({ sign, zero_deg }, i) => (shown_deg[i]! - this.added(i, shown_deg) - zero_deg) / (sign * DEG),
    );
  }

  /** Shown values of joint angles: an axis that others are coupled with is itself not coupled. */
  degrees(q_rad: ArrayLike<number>): number[] {
    const alone = this.section.axes.map(({ sign, zero_deg }, i) => zero_deg + sign * q_rad[i]! * DEG);
    return alone.map((value, i) => value + this.added(i, alone));
  }

  /** The wrist of a robot whose axis 5 is shown on that side of 0, as branches name it; tried, not worked out. */
  wristAt(robot: Robot, side: 1 | -1): Partial<Branch> {
    const shown = this.degrees(robot.home_rad);
    shown[4] = side * 30;
    const branch = branchOf(robot, this.radians(shown));
    return branch === undefined ? {} : { wrist: branch.wrist };
  }

  /** Which way an axis turns as it is shown, seen from the robot's own file. */
  sign(axis: number): 1 | -1 {
    return this.section.axes[axis]!.sign;
  }
}

/** Where the parts of an upright arm with six axes are, from its base [m]. */
export interface ArmPoints {
  readonly shoulder: Vector3;
  readonly elbow: Vector3;
  readonly wrist: Vector3;
  /** The wrist in front of axis 1, as the arm faces [m]. */
  readonly ahead_m: number;
  /** Above 0 where the forearm is folded forwards from the upper arm [m²]. */
  readonly folded: number;
}

/**
 * Read off the links, without the lengths of any family.
 *
 * @param leansForward  1 where a growing value of axis 2, as it is shown, leans the upper arm forwards, else -1.
 */
export function armPoints(
  robot: Robot,
  axes: ShownAxes,
  q_rad: ArrayLike<number>,
  leansForward: 1 | -1 = 1,
): ArmPoints {
  const links = Array.from({ length: robot.arm.joints.length + 1 }, () => identity<"base", "link">());
  linkPoses(robot.arm, q_rad, links);
  const axis = (joint: number): Vector3 => rotate(links[joint]!.quaternion, robot.arm.joints[joint - 1]!.axis);
  const shoulder = links[2]!.position;
  const elbow = links[3]!.position;
  const across = times(leansForward * axes.sign(1), axis(2));
  // The direction that the arm faces: level, and square to axis 2.
  const facing: Vector3 = [across[1], -across[0], 0];
  const wrist = nearest(links[5]!.position, axis(5), links[4]!.position, axis(4));
  return {
    shoulder,
    elbow,
    wrist,
    ahead_m: dot(minus(wrist, links[1]!.position), facing),
    folded: dot(cross(minus(elbow, shoulder), minus(wrist, elbow)), across),
  };
}

const times = (by: number, [x, y, z]: Vector3): Vector3 => [by * x, by * y, by * z];
const minus = (a: Vector3, b: Vector3): Vector3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Vector3, b: Vector3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vector3, b: Vector3): Vector3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** The point of the line through p along u that is nearest to the line through o along v; p where they are parallel. */
function nearest(p: Vector3, u: Vector3, o: Vector3, v: Vector3): Vector3 {
  const b = dot(u, v);
  const apart = minus(o, p);
  const square = 1 - b * b;
  if (square < 1e-12) return p;
  const s = (dot(apart, u) - b * dot(apart, v)) / square;
  return [p[0] + s * u[0], p[1] + s * u[1], p[2] + s * u[2]];
}
