import { degrees, millimetres, toKukaAbc, type Pose } from "@twincell/core";
import { singleText } from "../../parser/index.ts";
import type { AxisConvention } from "../robots.ts";

/** A millionth of a millimetre or of a degree is arithmetic, not a wish. */
const tidy = (value: number): string => singleText(Math.abs(value) < 1e-6 ? 0 : value);

/** `X 1,Y 2,Z 3,A 4,B 5,C 6` in mm and degrees. */
export function frameText({ position: [x, y, z], quaternion }: Pose): string {
  const [a, b, c] = toKukaAbc(quaternion);
  return `X ${tidy(millimetres(x))},Y ${tidy(millimetres(y))},Z ${tidy(millimetres(z))},A ${tidy(a)},B ${tidy(b)},C ${tidy(c)}`;
}

export const axisValues = (q_rad: ArrayLike<number>, { signs, offsets_deg }: AxisConvention): number[] =>
  Array.from(q_rad, (q, i) => signs[i]! * degrees(q) + offsets_deg[i]!);

/** `A1 1,A2 2,A3 3,A4 4,A5 5,A6 6` in degrees. */
export const axisText = (q_rad: ArrayLike<number>, convention: AxisConvention): string =>
  axisValues(q_rad, convention)
    .map((value, i) => `A${i + 1} ${tidy(value)}`)
    .join(",");

export const lengthText = (length_m: number): string => tidy(millimetres(length_m));
