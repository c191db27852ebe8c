import type { Vector3 } from "@twincell/core";

/** Capitals of the typeface are this part of its size. */
const CAPITAL = 0.727;
/** Smaller capitals cannot be read in a headset [minutes of arc]: 22 mm at 1.5 m. */
export const LEAST_CAPITAL_ARCMIN = 50;

/** How high capitals of that size are [m]. */
export const capital_m = (size_px: number, metresPerPixel: number): number => size_px * metresPerPixel * CAPITAL;

/** How high they are to an eye that far away [minutes of arc]. */
export const capital_arcmin = (size_px: number, metresPerPixel: number, away_m: number): number =>
  (Math.atan2(capital_m(size_px, metresPerPixel), away_m) * 60 * 180) / Math.PI;

/** How far the eyes are from the farthest letter of a panel that hangs down from `top` [m]. */
export const farthest_m = (eye: Vector3, top: Vector3, hangs_m: number): number =>
  Math.max(
    Math.hypot(top[0] - eye[0], top[1] - eye[1], top[2] - eye[2]),
    Math.hypot(top[0] - eye[0], top[1] - hangs_m - eye[1], top[2] - eye[2]),
  );
