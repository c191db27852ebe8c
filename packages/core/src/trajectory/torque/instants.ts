import type { Segment } from "../plan.ts";
import { intervalAccelerations, sampleSegment, segmentKnot } from "../sample.ts";

/** Angles, speeds and accelerations of the joints at an instant of a segment; one per caller. */
export interface JointState {
  /** Since the start of the segment [s]. */
  t_s: number;
  readonly q: Float64Array;
  readonly qd: Float64Array;
  readonly qdd: Float64Array;
}
export const jointState = (joints: number): JointState => ({
  t_s: 0,
  q: new Float64Array(joints),
  qd: new Float64Array(joints),
  qdd: new Float64Array(joints),
});

/**
 * Goes through the instants of a segment in order: every knot of its cubics from both sides, since accelerations may
 * jump there, and as many in between as `period_s` asks for. A rest is seen at its beginning and its end.
 *
 * @param state  receives each instant before `visit` is called.
 */
export function eachInstant(segment: Segment, period_s: number, state: JointState, visit: () => void): void {
  const { q, qd, qdd } = state;
  const n = q.length;
  if (segment.kind === "rest" || segment.times_s.length < 2) {
    sampleSegment(segment, 0, q, qd);
    qd.fill(0);
    qdd.fill(0);
    for (const t_s of segment.duration_s > 0 ? [0, segment.duration_s] : [0]) {
      state.t_s = t_s;
      visit();
    }
    return;
  }
  const { times_s } = segment;
  const bend = new Float64Array(2 * n);
  for (let i = 0; i + 1 < times_s.length; i++) {
    const from_s = times_s[i]!;
    const h = times_s[i + 1]! - from_s;
    const parts = Math.max(1, Math.ceil(h / period_s));
    if (!(h > 0)) continue;
    intervalAccelerations(segment, i, n, bend);
    for (let k = 0; k <= parts; k++) {
      const u = k / parts;
      state.t_s = k === parts ? times_s[i + 1]! : from_s + u * h;
      sampleSegment(segment, state.t_s, q, qd);
      for (let j = 0; j < n; j++) qdd[j] = bend[j]! + (bend[n + j]! - bend[j]!) * u;
      visit();
    }
  }
}

/**
 * The joints at one instant of a segment, `t_s` counted from its start; at a knot as the interval after it has them.
 */
export function instantAt(segment: Segment, t_s: number, state: JointState): void {
  const { q, qd, qdd } = state;
  const n = q.length;
  state.t_s = t_s;
  sampleSegment(segment, t_s, q, qd);
  qdd.fill(0);
  if (segment.kind === "rest" || segment.times_s.length < 2) return;
  const i = segmentKnot(segment, t_s);
  const from_s = segment.times_s[i]!;
  const h = segment.times_s[i + 1]! - from_s;
  const u = h > 0 ? Math.min(1, Math.max(0, (t_s - from_s) / h)) : 0;
  const bend = new Float64Array(2 * n);
  intervalAccelerations(segment, i, n, bend);
  for (let j = 0; j < n; j++) qdd[j] = bend[j]! + (bend[n + j]! - bend[j]!) * u;
}
