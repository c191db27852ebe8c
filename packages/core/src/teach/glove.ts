import { radians } from "../spatial/units.ts";

/** What one finger's sensor reads flat and fully bent, for one hand (rows M-26, M-27, M-29): 12-bit numbers. */
export interface FingerCalibration {
  readonly flat: number;
  readonly bent: number;
}

/** How far a fully bent finger is bent. */
const FULL_RAD = radians(90);
const MOST_RAW = 4095;

export type FingerRange =
  | { readonly kind: "calibrated"; readonly finger: FingerCalibration }
  | { readonly kind: "too-small"; readonly sentence: string };

/** Counts between flat and bent below which noise would look like a moving finger. */
const LEAST_RANGE = 64;

/** A calibration from readings of a flat and of a bent finger:  DynamicRange = raw_max − raw_min. */
export function calibrateFinger(readings: ArrayLike<number>): FingerRange {
  let flat = Infinity;
  let bent = -Infinity;
  for (let i = 0; i < readings.length; i++) {
    const raw = readings[i]!;
    if (Number.isInteger(raw) && raw >= 0 && raw <= MOST_RAW) {
      flat = Math.min(flat, raw);
      bent = Math.max(bent, raw);
    }
  }
  return bent - flat >= LEAST_RANGE
    ? { kind: "calibrated", finger: { flat, bent } }
    : {
        kind: "too-small",
        sentence: `The finger moved through ${Math.max(0, bent - flat) || 0} counts; ${LEAST_RANGE} are needed. Open and close the hand fully.`,
      };
}

/**
 * Bending of a finger (row M-28):  angle = (raw − flat) / (bent − flat) · 90°, held between 0 and 90°.
 *
 * @see Malaya, VR teaching with data glove, Eqs 1–2; golden G-08: the middle of the range is 45°.
 */
export function fingerBend(raw: number, { flat, bent }: FingerCalibration): number {
  return Math.max(0, Math.min(1, (raw - flat) / (bent - flat))) * FULL_RAD;
}
