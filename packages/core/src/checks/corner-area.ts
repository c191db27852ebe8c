import type { MotionSegment } from "../trajectory/plan.ts";
import { sampleSegment } from "../trajectory/sample.ts";
import type { PassedCorner } from "./corners.ts";

/** All that a controller may make of one corner of a plan, as postures all over it. Plain data. */
export interface CornerArea {
  /** When the plan comes into it and leaves it [s]. */
  readonly from_s: number;
  readonly to_s: number;
  /** [rad] */
  readonly postures_rad: readonly Float64Array[];
  /** No posture of it is farther from the nearest of these in any joint [rad]. */
  readonly spacing_rad: number;
}

/** Postures of an area are so far apart in any joint at most [rad], unless that takes more of them than these. */
const SPACING_RAD = 0.1;
const MOST_CHORDS = 6;
const MOST_ON_CHORD = 12;
/** The plan is searched for where it comes into the area and leaves it in steps of this length [s]. */
const SEARCH_S = 0.005;

/** The area of a corner; undefined where the arm reaches none of it. */
export function cornerArea({ sweep, before, behind }: PassedCorner): CornerArea | undefined {
  const reached = (u: number): readonly Float64Array[] | undefined => sweep.chord(u);
  const widest = reached(1);
  const far_rad = widest === undefined ? SPACING_RAD * MOST_CHORDS : farthest(widest, reached(0) ?? widest);
  const chords = Math.min(MOST_CHORDS, Math.max(1, Math.ceil(far_rad / SPACING_RAD)));
  const postures_rad: Float64Array[] = [];
  let spacing_rad = far_rad / chords;
  for (let c = chords; c > 0; c--) {
    const chord = c === chords ? widest : reached(c / chords);
    if (chord === undefined) continue;
    const way_rad = chord.slice(1).reduce((sum, q, k) => sum + apart(q, chord[k]!), 0);
    const each_rad = Math.max(SPACING_RAD, way_rad / MOST_ON_CHORD);
    postures_rad.push(chord[0]!);
    for (let k = 1; k < chord.length; k++) {
      const [a, b] = [chord[k - 1]!, chord[k]!];
      const pieces = Math.max(1, Math.ceil(apart(a, b) / each_rad));
      for (let p = 1; p <= pieces; p++) postures_rad.push(a.map((q, j) => q + ((b[j]! - q) * p) / pieces));
    }
    spacing_rad = Math.max(spacing_rad, each_rad / 2);
  }
  if (postures_rad.length === 0) return undefined;
  return {
    from_s: before.start_s + (widest === undefined ? 0 : nearestTime(before, widest[0]!)),
    to_s: behind.start_s + (widest === undefined ? behind.duration_s : nearestTime(behind, widest.at(-1)!)),
    postures_rad,
    spacing_rad,
  };
}

/** How far two postures are apart in the joint that differs most [rad]. */
function apart(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let most = 0;
  for (let j = 0; j < a.length; j++) most = Math.max(most, Math.abs(a[j]! - b[j]!));
  return most;
}
const farthest = (a: readonly Float64Array[], b: readonly Float64Array[]): number =>
  a.reduce((most, q, k) => Math.max(most, apart(q, b[k]!)), 0);

/** When a motion is nearest to a posture, after its start [s]. */
function nearestTime(segment: MotionSegment, q_rad: Float64Array): number {
  const q = new Float64Array(q_rad.length);
  let [least_rad, at_s] = [Infinity, 0];
  const steps = Math.max(1, Math.ceil(segment.duration_s / SEARCH_S));
  for (let k = 0; k <= steps; k++) {
    const t_s = (segment.duration_s * k) / steps;
    sampleSegment(segment, t_s, q);
    const off_rad = apart(q, q_rad);
    if (off_rad < least_rad) [least_rad, at_s] = [off_rad, t_s];
  }
  return at_s;
}
