import { allBranches, fromMatrix, type Pose, type Robot } from "@twincell/core";
import { ShownAxes } from "../../parser/index.ts";

const DEG = 180 / Math.PI;
/** What the rounding of a written position may add to an axis at its limit. */
const LIMIT_SLACK_RAD = 1e-4;
/**
 * This close to a border of a manipulator type either side is right [°, m]: next to it, and as far as the rounding of a
 * written position moves a stretched arm or a straight wrist.
 */
export const BORDERS = { exact: { deg: 1e-3, m: 1e-6 }, written: { deg: 0.5, m: 2e-3 } } as const;

/** The axes S, L, U, R, B, T of a robot as its controller shows them, and the manipulator types of a posture. */
export class Arm {
  private readonly robot: Robot;
  private readonly shown: ShownAxes;

  private constructor(robot: Robot, shown: ShownAxes) {
    this.robot = robot;
    this.shown = shown;
  }

  /** Undefined for a robot whose axes are not known here. */
  static of(robot: Robot): Arm | undefined {
    const shown = ShownAxes.of(robot, "inform");
    return shown === undefined ? undefined : new Arm(robot, shown);
  }

  radians(axes_deg: readonly number[]): number[] {
    return this.shown.radians(axes_deg);
  }

  degrees(q_rad: ArrayLike<number>): number[] {
    return this.shown.degrees(q_rad);
  }

  /** Axis values that reach a pose within the limits, every turn of every axis, nearest first. */
  reaching(baseFromFlange: Pose<"base", "flange">, near_deg: readonly number[]): number[][] {
    const found: number[][] = [];
    const { joints } = this.robot.arm;
    for (const q of allBranches(this.robot, baseFromFlange, this.radians(near_deg))) {
      let copies: number[][] = [[]];
      for (const [i, { limits }] of joints.entries()) {
        const turns = [-1, 0, 1]
          .map(n => q[i]! + 2 * Math.PI * n)
          .filter(x => x >= limits.lower_rad - LIMIT_SLACK_RAD && x <= limits.upper_rad + LIMIT_SLACK_RAD);
        copies = copies.flatMap(copy => turns.map(x => [...copy, x]));
      }
      for (const copy of copies) found.push(this.degrees(copy));
    }
    const travel = (axes: readonly number[]): number =>
      axes.reduce((sum, value, i) => sum + Math.abs(value - near_deg[i]!), 0);
    return found.sort((a, b) => travel(a) - travel(b));
  }

  /**
   * Whether axis values are of that manipulator type: flip 0 / no flip 1 by the angle of R, upper 0 / lower arm 1,
   * front 0 / rear 1, and R, T, S below 180° 0 / from 180° on 1.
   */
  isOfType(
    axes_deg: readonly number[],
    rconf: readonly number[],
    { deg, m }: { readonly deg: number; readonly m: number } = BORDERS.exact,
  ): boolean {
    // Without a type every posture will do: the nearest is taken.
    if (rconf.length === 0) return true;
    const [flip = 0, lower = 0, rear = 0, rBig = 0, tBig = 0, sBig = 0] = rconf;
    const [s, l, u, r, , t] = axes_deg as [number, number, number, number, number, number];
    const { ahead_m, above_m } = this.planar(l, u);
    const folded = ((r % 360) + 360) % 360;
    return (
      agrees(Math.cos(folded / DEG) * 90, flip === 0, deg) &&
      agrees(above_m * (ahead_m < 0 ? -1 : 1), lower === 0, m) &&
      agrees(ahead_m, rear === 0, m) &&
      agrees(Math.abs(r) - 180, rBig === 1, deg) &&
      agrees(Math.abs(t) - 180, tBig === 1, deg) &&
      agrees(Math.abs(s) - 180, sBig === 1, deg)
    );
  }

  /**
   * In the plane of the arm, x ahead and z up: how far the wrist is in front of axis S, and on which side of the line
   * from axis L to the wrist axis U is. L counts from upright to the front, U upwards from square to the upper arm.
   */
  private planar(l_deg: number, u_deg: number): { readonly ahead_m: number; readonly above_m: number } {
    const { family } = this.robot;
    if (family.kind !== "ortho-parallel") return { ahead_m: 1, above_m: 1 };
    const { a1_m, c2_m, c3_m } = family;
    const rise_m = -family.a2_m;
    const l = l_deg / DEG;
    const tilt = (u_deg - l_deg) / DEG;
    const elbow = [c2_m * Math.sin(l), c2_m * Math.cos(l)] as const;
    const wrist = [
      elbow[0] + c3_m * Math.cos(tilt) - rise_m * Math.sin(tilt),
      elbow[1] + c3_m * Math.sin(tilt) + rise_m * Math.cos(tilt),
    ] as const;
    return { ahead_m: a1_m + wrist[0], above_m: wrist[0] * elbow[1] - wrist[1] * elbow[0] };
  }
}

/** A value on the side of 0 that is asked for, or too close to tell. */
const agrees = (value: number, positive: boolean, border: number): boolean =>
  Math.abs(value) < border || value > 0 === positive;

/** X, Y, Z [mm], Rx, Ry, Rz [deg] about fixed axes: the matrix Rz · Ry · Rx, multiplied out. */
export function poseOf<Into extends string = string, From extends string = string>([
  x,
  y,
  z,
  rx,
  ry,
  rz,
]: readonly number[]): Pose<Into, From> {
  const [cx, sx] = turn(rx!);
  const [cy, sy] = turn(ry!);
  const [cz, sz] = turn(rz!);
  const quaternion = fromMatrix([
    cz * cy,
    cz * sy * sx - sz * cx,
    cz * sy * cx + sz * sx,
    sz * cy,
    sz * sy * sx + cz * cx,
    sz * sy * cx - cz * sx,
    -sy,
    cy * sx,
    cy * cx,
  ]);
  return { position: [x! / 1000, y! / 1000, z! / 1000], quaternion };
}

function turn(angle_deg: number): readonly [cosine: number, sine: number] {
  // Quarter turns are exact.
  const quarter = ((angle_deg % 360) + 360) % 360;
  return quarter === 0
    ? [1, 0]
    : quarter === 90
      ? [0, 1]
      : quarter === 180
        ? [-1, 0]
        : quarter === 270
          ? [0, -1]
          : [Math.cos(angle_deg / DEG), Math.sin(angle_deg / DEG)];
}
