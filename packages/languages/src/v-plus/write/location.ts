import { shownAxes } from "../../emitter/index.ts";
import { millimetres, toVplusYpr, type Pose, type VendorSection } from "@twincell/core";
import { singleText } from "../../parser/index.ts";

/** TRANS(x,y,z,yaw,pitch,roll) in mm and degrees. */
export function transText({ position, quaternion }: Pose): string {
  const numbers = [...position.map(millimetres), ...toVplusYpr(quaternion)];
  return `TRANS(${numbers.map(tidy).join(",")})`;
}

/**
 * #PPOINT(j1,…,jn) in degrees as V+ counts them: no blanks, ASCII minus, seven significant digits, no exponent (rows
 * N-54 … N-56).
 */
export function ppointText(q_rad: ArrayLike<number>, section: VendorSection): string {
  return `#PPOINT(${shownAxes(section, q_rad).map(tidy).join(",")})`;
}

/** A millionth of a millimetre or of a degree is arithmetic, not a wish. */
const tidy = (value: number): string => singleText(Math.abs(value) < 1e-6 ? 0 : value);
