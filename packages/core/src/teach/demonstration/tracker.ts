import type { Vector3 } from "../../spatial/vector.ts";

/** An accelerometer's line:  a = slope · V + intercept  (row M-30). */
export interface AccelerometerLine {
  readonly slope_mps2_per_V: number;
  readonly intercept_mps2: number;
}

export type FittedLine =
  | { readonly kind: "fitted"; readonly line: AccelerometerLine; readonly rms_mps2: number }
  | { readonly kind: "too-few"; readonly sentence: string };

/** Voltages nearer to each other than this tell no slope [V]. */
const LEAST_SPAN_V = 0.05;

/**
 * The line through known accelerations, by least squares (row M-30), for instance +g, 0 and −g with the tracker turned.
 *
 *   slope = Σ (V − V̄)(a − ā) / Σ (V − V̄)²,   intercept = ā − slope V̄
 *
 * @see Malaya, VR teaching with data glove, Eq 3.
 */
export function fitAccelerometer(
  readings: readonly { readonly voltage_V: number; readonly acceleration_mps2: number }[],
): FittedLine {
  const usable = readings.filter(
    ({ voltage_V, acceleration_mps2 }) =>
      Number.isFinite(acceleration_mps2) && voltage_V >= 0 && voltage_V <= HIGHEST_V,
  );
  const mean = (of: (reading: (typeof usable)[number]) => number): number =>
    usable.reduce((sum, reading) => sum + of(reading), 0) / usable.length;
  const voltages = usable.map(({ voltage_V }) => voltage_V);
  const span_V = usable.length > 0 ? Math.max(...voltages) - Math.min(...voltages) : 0;
  if (span_V < LEAST_SPAN_V)
    return {
      kind: "too-few",
      sentence: `The readings span ${span_V.toFixed(3)} V; two accelerations at least ${LEAST_SPAN_V} V apart are needed.`,
    };
  const middle_V = mean(reading => reading.voltage_V);
  const middle_mps2 = mean(reading => reading.acceleration_mps2);
  let along = 0;
  let across = 0;
  for (const { voltage_V, acceleration_mps2 } of usable) {
    along += (voltage_V - middle_V) ** 2;
    across += (voltage_V - middle_V) * (acceleration_mps2 - middle_mps2);
  }
  const slope_mps2_per_V = across / along;
  const line = { slope_mps2_per_V, intercept_mps2: middle_mps2 - slope_mps2_per_V * middle_V };
  const squares = mean(
    ({ voltage_V, acceleration_mps2 }) => (accelerationOf(voltage_V, line) - acceleration_mps2) ** 2,
  );
  return { kind: "fitted", line, rms_mps2: Math.sqrt(squares) };
}

/** The tracker's electronics give 0 … 5 V. */
export const HIGHEST_V = 5;

/** a = slope · V + intercept. */
export const accelerationOf = (voltage_V: number, { slope_mps2_per_V, intercept_mps2 }: AccelerometerLine): number =>
  slope_mps2_per_V * voltage_V + intercept_mps2;

export interface TrackerOptions {
  /**
   * The cut-off line (row M-33): an acceleration below it in all three axes is a fluctuation at rest, and counts as
   * zero.
   */
  readonly cutOff_mps2: number;
  /** After the tracker stayed below the cut-off line for this long it stands: its velocity is set to zero. */
  readonly standingAfter_s: number;
}
/** Three times the noise at rest of common accelerometers, and a fifth of a second. */
export const TRACKER_DEFAULTS: TrackerOptions = { cutOff_mps2: 0.15, standingAfter_s: 0.2 };

/** A tracker's way from its accelerations, one entry a sample; it begins at rest at the origin. */
export interface TrackedWay {
  readonly position_m: readonly Vector3[];
  readonly velocity_mps: readonly Vector3[];
}

/**
 * Positions by integrating twice (rows M-31, M-32), each acceleration held to the next sample:
 *
 *   v = u + a t,   s = u t + ½ a t²
 *
 * The cut-off line alone leaves the velocity that wrong accelerations added up to; standing still resets it (a
 * zero-velocity update), and only the velocity: the position that was reached stays.
 */
export function integrateTracker(
  times_s: readonly number[],
  acceleration_mps2: readonly Vector3[],
  { cutOff_mps2, standingAfter_s }: TrackerOptions = TRACKER_DEFAULTS,
): TrackedWay {
  const position_m: Vector3[] = [[0, 0, 0]];
  const velocity_mps: Vector3[] = [[0, 0, 0]];
  let quietSince_s = times_s[0] ?? 0;
  for (let i = 1; i < times_s.length; i++) {
    const t_s = times_s[i]! - times_s[i - 1]!;
    const measured = acceleration_mps2[i - 1]!;
    const quiet = measured.every(a => Math.abs(a) < cutOff_mps2);
    if (!quiet) quietSince_s = times_s[i]!;
    const u = velocity_mps[i - 1]!;
    const stands = quiet && times_s[i]! - quietSince_s >= standingAfter_s;
    const v: Vector3 = [0, 0, 0];
    const s: Vector3 = [...position_m[i - 1]!];
    if (!stands)
      for (let k = 0; k < 3; k++) {
        const a = quiet ? 0 : measured[k]!;
        v[k] = u[k]! + a * t_s;
        s[k]! += u[k]! * t_s + 0.5 * a * t_s * t_s;
      }
    velocity_mps.push(v);
    position_m.push(s);
  }
  return { position_m, velocity_mps };
}
