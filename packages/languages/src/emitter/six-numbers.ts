import { degrees, millimetres, toEulerAngles, type Pose } from "@twincell/core";
import { fixed } from "./numbers.ts";

/** A tenth of a micrometre; a hundred-thousandth of a degree. */
const MM_DECIMALS = 4;
const DEG_DECIMALS = 5;
const UPRIGHT = "90";

export const mmText = (value_m: number): string => fixed(millimetres(value_m), MM_DECIMALS);
/** An angle in degrees as texts of BASICs write it. */
export const degreesText = (value_deg: number): string => fixed(value_deg, DEG_DECIMALS);
export const degText = (value_rad: number): string => fixed(degrees(value_rad), DEG_DECIMALS);

/**
 * Turns about the fixed x, y and z [°], R = Rz · Ry · Rx. Where the second is upright to the last digit, the first says
 * nothing: it is 0.
 */
export function turnTexts(q: Pose["quaternion"]): readonly [aboutX: string, aboutY: string, aboutZ: string] {
  const [c, b, a] = toEulerAngles("zyx", q);
  const pitch = degText(b);
  if (pitch !== UPRIGHT && pitch !== `-${UPRIGHT}`) return [inTurn(a), pitch, inTurn(c)];
  return ["0", pitch, inTurn(c - Math.sign(b) * a)];
}

/** An angle within half a turn; −180° is 180°. */
function inTurn(angle_rad: number): string {
  const text = degText(angle_rad - 2 * Math.PI * Math.round(angle_rad / (2 * Math.PI)));
  return text === "-180" ? "180" : text;
}
