import type { Vector3 } from "@twincell/core";

/** Drawn and skipped lengths [m]; an empty pattern is a solid line. */
export type Pattern = readonly [number, number] | readonly [];

/** A rest of a dash shorter than this is rounding. */
const GRAIN_M = 1e-9;

/** Straight pieces (6 numbers each) of a polyline drawn in a dash pattern that runs on around corners. */
export function dashes(points: readonly Vector3[], pattern: Pattern, out: number[]): void {
  const [on, off] = pattern.length === 2 ? pattern : [Infinity, 0];
  let drawing = true;
  let left = on;
  for (let i = 0; i + 1 < points.length; i++) {
    const a = points[i]!;
    const b = points[i + 1]!;
    const length = Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    let from = 0;
    while (length - from > GRAIN_M) {
      const to = Math.min(length, from + left);
      const s = from / length;
      const t = to / length;
      if (drawing)
        for (const at of [s, t])
          out.push(a[0] + (b[0] - a[0]) * at, a[1] + (b[1] - a[1]) * at, a[2] + (b[2] - a[2]) * at);
      left -= to - from;
      from = to;
      if (left <= GRAIN_M) {
        drawing = !drawing;
        left = drawing ? on : off;
      }
    }
  }
}

/** Points at equal distances along a polyline, the first at half a distance. */
export function stations(points: readonly Vector3[], every_m: number, out: number[]): void {
  let next = every_m / 2;
  let run = 0;
  let any = false;
  for (let i = 0; i + 1 < points.length; i++) {
    const a = points[i]!;
    const b = points[i + 1]!;
    const length = Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    while (next <= run + length && length > 0) {
      const t = (next - run) / length;
      out.push(a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t);
      next += every_m;
      any = true;
    }
    run += length;
  }
  const first = points[Math.floor(points.length / 2)];
  if (!any && first) out.push(...first);
}
