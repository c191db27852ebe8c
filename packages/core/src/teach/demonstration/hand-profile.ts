import { radians } from "../../spatial/units.ts";
import { calibrateFinger, fingerBend, type FingerCalibration } from "../glove.ts";
import type { AccelerometerLine } from "./tracker.ts";

/** What one person's glove and tracker say (row M-29): it is calibrated for every hand anew. */
export interface HandProfile {
  readonly format: "twincell.hand";
  readonly version: 1;
  readonly name: string;
  /** Flat and fully bent reading of each finger's sensor, thumb first; 12-bit numbers (row M-26). */
  readonly fingers: readonly FingerCalibration[];
  readonly accelerometer: AccelerometerLine;
}

/** Thumb to little finger. */
export const FINGERS = 5;
/**
 * The hand is closed from this mean bend of its fingers on, and open again below the other: a trembling hand is no
 * gripper.
 */
export const CLOSED_FROM_RAD = radians(50);
export const OPEN_BELOW_RAD = radians(35);

export type NewProfile =
  | { readonly kind: "profile"; readonly profile: HandProfile }
  | { readonly kind: "incomplete"; readonly sentence: string };

/**
 * A profile from readings of a hand that opened and closed (row M-27).
 *
 * @param readings  one list of raw numbers a finger.
 */
export function profileOfHand(
  name: string,
  readings: readonly ArrayLike<number>[],
  accelerometer: AccelerometerLine,
): NewProfile {
  if (readings.length !== FINGERS)
    return { kind: "incomplete", sentence: `${readings.length} fingers were read; a hand has ${FINGERS}.` };
  const fingers: FingerCalibration[] = [];
  for (const [i, raw] of readings.entries()) {
    const answer = calibrateFinger(raw);
    if (answer.kind === "too-small") return { kind: "incomplete", sentence: `Finger ${i + 1}: ${answer.sentence}` };
    fingers.push(answer.finger);
  }
  return { kind: "profile", profile: { format: "twincell.hand", version: 1, name, fingers, accelerometer } };
}

/** Parses a profile that was kept; null when the text is none. */
export function parseHandProfile(text: string): HandProfile | null {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return null;
  }
  if (!isRecord(value) || value["format"] !== "twincell.hand" || value["version"] !== 1) return null;
  const { name, fingers, accelerometer } = value;
  const number = (of: unknown, key: string): boolean => isRecord(of) && Number.isFinite(of[key]);
  const complete =
    typeof name === "string" &&
    Array.isArray(fingers) &&
    fingers.length === FINGERS &&
    fingers.every(finger => number(finger, "flat") && number(finger, "bent")) &&
    number(accelerometer, "slope_mps2_per_V") &&
    number(accelerometer, "intercept_mps2");
  return complete ? (value as unknown as HandProfile) : null;
}

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);

/** Mean bend of the fingers [rad]; readings that no 12-bit sensor gives count as not bent. */
export function handBend(raw: readonly number[], { fingers }: HandProfile): number {
  const bends = fingers.map((finger, i) => {
    const reading = raw[i] ?? NaN;
    return Number.isInteger(reading) && reading >= 0 && reading <= 4095 ? fingerBend(reading, finger) : 0;
  });
  return bends.reduce((sum, bend) => sum + bend, 0) / bends.length;
}

/** Whether the hand is closed now, when it was or was not before (row M-24: closing picks, opening places). */
export const handClosed = (bend_rad: number, was: boolean): boolean =>
  was ? bend_rad >= OPEN_BELOW_RAD : bend_rad >= CLOSED_FROM_RAD;
