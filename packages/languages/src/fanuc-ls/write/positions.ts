import {
  branchOf,
  degrees,
  toFanucWpr,
  type Pose,
  type Robot,
  type VendorSection,
  wristAboveZero,
} from "@twincell/core";
import { shownAxes } from "../../emitter/index.ts";

/** What a listing holds of a length in mm or an angle in degrees. */
const DECIMALS = 3;
const UPRIGHT = 90;

/** A number as a listing shows it, never as minus zero. */
function shown(value: number): string {
  const text = value.toFixed(DECIMALS);
  return /^-0\.0+$/.test(text) ? text.slice(1) : text;
}
const inTurn = (angle: number): string => {
  const text = shown(angle);
  return text === "-180.000" ? "180.000" : text;
};

/**
 * X, Y, Z [mm] and W, P, R [deg], R = Rz(R)·Ry(P)·Rx(W). Where P is upright to the last digit W says nothing: it is 0.
 */
export function xyzwpr({ position, quaternion }: Pose): readonly [string, string, string, string, string, string] {
  const [w, p, r] = toFanucWpr(quaternion);
  const [x, y, z] = position.map(v => shown(v * 1000)) as [string, string, string];
  const pitch = shown(p);
  if (Math.abs(Number(pitch)) !== UPRIGHT) return [x, y, z, inTurn(w), pitch, inTurn(r)];
  const turn = r - Math.sign(p) * w;
  return [x, y, z, "0.000", pitch, inTurn(turn > 180 ? turn - 360 : turn <= -180 ? turn + 360 : turn)];
}

/**
 * Joint angles as the pendant shows them. An axis that is shown with another counts from what is written of that one,
 * so that the arm's own angle is as fine as the others.
 */
export function pendantJoints(q_rad: ArrayLike<number>, section: VendorSection): readonly string[] {
  const alone = section.axes.map(({ sign, zero_deg }, i) => sign * degrees(q_rad[i]!) + zero_deg);
  const written = alone.map(angle => Number(shown(angle)));
  for (const { axis, with: other, factor } of section.couplings ?? []) alone[axis - 1]! += factor * written[other - 1]!;
  return alone.map(shown);
}

/** Wrist, elbow, shoulder, and the whole turns of axes 1, 4 and 6: 0 within half a turn of zero. */
export function configOf(robot: Robot, section: VendorSection, q_rad: ArrayLike<number>): string {
  const branch = branchOf(robot, q_rad);
  const axes = shownAxes(section, q_rad);
  const turn = (joint: number): number => Math.floor((Number(shown(axes[joint]!)) + 180) / 360);
  const flags = `${branch?.wrist === wristAboveZero(robot) ? "F" : "N"} ${branch?.elbow === "down" ? "D" : "U"} ${branch?.shoulder === "back" ? "B" : "T"}`;
  return `${flags}, ${turn(0)}, ${turn(3)}, ${turn(5)}`;
}

export interface Position {
  readonly uf: number;
  readonly ut: number;
  readonly step: string;
  readonly config?: string;
  readonly values: readonly string[];
}

/** The lines of one record of /POS. */
export function positionLines(number: number, { uf, ut, config, values }: Position): readonly string[] {
  const field = (name: string, i: number, unit: string): string => `${name} = ${values[i]!.padStart(9)} ${unit}`;
  const first = `\tUF : ${uf}, UT : ${ut},`;
  return config === undefined
    ? [
        `P[${number}]{`,
        "   GP1:",
        `${first}\t`,
        `\t${field("J1", 0, "deg")},\t${field("J2", 1, "deg")},\t${field("J3", 2, "deg")},`,
        `\t${field("J4", 3, "deg")},\t${field("J5", 4, "deg")},\t${field("J6", 5, "deg")}`,
        "};",
      ]
    : [
        `P[${number}]{`,
        "   GP1:",
        `${first}\t\tCONFIG : '${config}',`,
        `\t${field("X", 0, " mm")},\t${field("Y", 1, " mm")},\t${field("Z", 2, " mm")},`,
        `\t${field("W", 3, "deg")},\t${field("P", 4, "deg")},\t${field("R", 5, "deg")}`,
        "};",
      ];
}
