import type { Pose, Quaternion, Vector3 } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";

const UNITS_M = { MM: 1e-3, M: 1 } as const;
const UNITS_RAD = { DEG: Math.PI / 180, RAD: 1 } as const;
const X = 0;
const Y = 1;
const Z = 2;
/** Axes of the three turns, each about the axis as the turns before have left it. */
const TURNS = { ZYX: [Z, Y, X], ZYZ: [Z, Y, Z], XYZ: [X, Y, Z] } as const;

/** What the first line says of every number below it. */
export interface Header {
  readonly unit_m: number;
  readonly unit_rad: number;
  readonly turns: readonly [number, number, number];
  /** What poses that name no frame count from. */
  readonly from: "BASE" | "WORLD";
}

/** `POSES 1 MM DEG ZYX BASE` */
export function readHeader(cursor: Cursor): Header {
  cursor.expect("POSES");
  const { here } = cursor;
  const version = cursor.number("the version 1");
  if (version !== 1)
    throw new TextError(here, "the version 1", `The list is of version ${version}; version 1 is read.`);
  const length = cursor.oneOf(["MM", "M"]);
  const angle = cursor.oneOf(["DEG", "RAD"]);
  const turns = cursor.oneOf(["ZYX", "ZYZ", "XYZ"]);
  const from = cursor.oneOf(["BASE", "WORLD"]);
  cursor.expectEnd();
  return { unit_m: UNITS_M[length], unit_rad: UNITS_RAD[angle], turns: TURNS[turns], from };
}

/**
 * Position and three turns, in the units of the header:  R = R1(a) · R2(b) · R3(c), each R of half its angle as
 * quaternion, multiplied out axis by axis.
 */
export function poseOf<Into extends string, From extends string>(
  [x, y, z, ...angles]: readonly number[],
  { unit_m, unit_rad, turns }: Header,
): Pose<Into, From> {
  let turned: Quaternion = [0, 0, 0, 1];
  for (const [i, axis] of turns.entries()) turned = turnedAbout(turned, axis, angles[i]! * unit_rad);
  return { position: [x! * unit_m, y! * unit_m, z! * unit_m], quaternion: turned };
}

/** q · (sin(angle/2) e_axis, cos(angle/2)) */
function turnedAbout([x, y, z, w]: Quaternion, axis: number, angle_rad: number): Quaternion {
  const s = Math.sin(angle_rad / 2);
  const c = Math.cos(angle_rad / 2);
  const v: Vector3 = [x, y, z];
  const next = (axis + 1) % 3;
  const last = (axis + 2) % 3;
  const out: Quaternion = [0, 0, 0, w * c - v[axis]! * s];
  out[axis] = v[axis]! * c + w * s;
  out[next] = v[next]! * c + v[last]! * s;
  out[last] = v[last]! * c - v[next]! * s;
  return out;
}
