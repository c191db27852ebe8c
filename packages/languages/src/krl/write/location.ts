import { millimetres, toKukaAbc, type Pose, type VendorSection } from "@twincell/core";
import { singleText } from "../../parser/index.ts";
import { shownAxes } from "../../emitter/index.ts";

/** A millionth of a millimetre or of a degree is arithmetic, not a wish. */
const tidy = (value: number): string => singleText(Math.abs(value) < 1e-6 ? 0 : value);

/** `X 1,Y 2,Z 3,A 4,B 5,C 6` in mm and degrees. */
export function frameText({ position: [x, y, z], quaternion }: Pose): string {
  const [a, b, c] = toKukaAbc(quaternion);
  return `X ${tidy(millimetres(x))},Y ${tidy(millimetres(y))},Z ${tidy(millimetres(z))},A ${tidy(a)},B ${tidy(b)},C ${tidy(c)}`;
}

/** `A1 1,A2 2,A3 3,A4 4,A5 5,A6 6` in degrees. */
export const axisText = (q_rad: ArrayLike<number>, convention: VendorSection): string =>
  shownAxes(convention, q_rad)
    .map((value, i) => `A${i + 1} ${tidy(value)}`)
    .join(",");

export const lengthText = (length_m: number): string => tidy(millimetres(length_m));
