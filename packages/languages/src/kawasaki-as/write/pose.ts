import { degrees, millimetres, type Pose } from "@twincell/core";
import { fixed } from "../../emitter/index.ts";

/** A tenth of a micrometre; a hundred-thousandth of a degree. */
const MM_DECIMALS = 4;
const DEG_DECIMALS = 5;
/** Sine of half the angle A below which O and T turn about the same axis: less than what the text can say of A. */
const STRAIGHT = 1e-7;

export const mm = (value_m: number): string => fixed(millimetres(value_m), MM_DECIMALS);
/** An angle, -180° excluded: it is 180°. */
export const deg = (value_rad: number): string => fixed(degrees(value_rad), DEG_DECIMALS);
/** Percentages and times. */
export const num = (value: number): string => fixed(value, 6);

/** O, A, T of a quaternion: Rz(O) · Ry(A) · Rz(T), A from 0° to 180°. Where O and T turn about one axis, T is 0. */
export function oatText([x, y, z, w]: Pose["quaternion"]): string {
  const bent = Math.hypot(x, y);
  const straight = Math.hypot(z, w);
  const sum = 2 * Math.atan2(z, w);
  const difference = 2 * Math.atan2(-x, y);
  if (bent < STRAIGHT) return `${turnText(sum)},0,0`;
  if (straight < STRAIGHT) return `${turnText(difference)},180,0`;
  return `${turnText((sum + difference) / 2)},${deg(2 * Math.atan2(bent, straight))},${turnText((sum - difference) / 2)}`;
}

/** TRANS(x, y, z, o, a, t): mm and degrees. */
export const transText = ({ position, quaternion }: Pose): string =>
  `TRANS(${position.map(mm).join(",")},${oatText(quaternion)})`;
/** #[jt1, …]: axis values as the controller shows them [°]. */
export const jointsText = (axes_deg: readonly number[]): string =>
  `#[${axes_deg.map(value => fixed(value, DEG_DECIMALS)).join(",")}]`;

function turnText(angle_rad: number): string {
  const text = deg(angle_rad - 2 * Math.PI * Math.round(angle_rad / (2 * Math.PI)));
  return text === "-180" ? "180" : text;
}
