import { armScratch, flangePose, identity, type Robot } from "@twincell/core";
import type { History } from "./history.ts";

/** A stretch of a history, sampled evenly from its start: n rows of joint angles. */
export interface Trace {
  readonly from_s: number;
  readonly period_s: number;
  readonly rows: number;
  readonly q_rad: Float64Array;
  readonly joints: number;
}

const MOST_ROWS = 20_000;

/** Rejects when a file is gone. */
export async function traceOf(history: History, from_s: number, to_s: number, wanted_s = 0.02): Promise<Trace> {
  const span_s = Math.max(0, to_s - from_s);
  const period_s = Math.max(wanted_s, span_s / MOST_ROWS);
  const rows = Math.floor(span_s / period_s + 1e-9) + 1;
  const q_rad = new Float64Array(rows * history.joints);
  for (let row = 0; row < rows; row++) {
    const at_s = from_s + row * period_s;
    q_rad.set((history.peek(at_s) ?? (await history.at(at_s))).q_rad, row * history.joints);
  }
  return { from_s, period_s, rows, q_rad, joints: history.joints };
}

/** How two cycles differ when they start together. */
export interface Comparison {
  /** Later minus earlier [s]. */
  readonly longer_s: number;
  /** Largest distance of the flanges at the same time since the start [m], and when. */
  readonly apart_m: number;
  readonly apartAt_s: number;
  readonly mean_m: number;
  /**
   * Largest distance of the flange of the second from the way of the first, whenever it is there [m]: the path alone,
   * without the timing.
   */
  readonly offPath_m: number;
  /** Largest difference of each joint at the same time [rad]. */
  readonly joints_rad: readonly number[];
}

/** Rows of the way of the first that are looked at for one of the second. */
const WAY_ROWS = 1000;

/** @param a, b  traces of one robot with the same period. */
export function compareTraces(robot: Robot, a: Trace, b: Trace): Comparison {
  const rows = Math.min(a.rows, b.rows);
  const { joints } = a;
  const scratch = armScratch();
  const pose = identity<"base", "flange">();
  const joints_rad = new Array<number>(joints).fill(0);
  const flanges = (trace: Trace): Float64Array => {
    const out = new Float64Array(trace.rows * 3);
    for (let row = 0; row < trace.rows; row++)
      out.set(
        flangePose(robot.arm, trace.q_rad.subarray(row * joints, (row + 1) * joints), pose, scratch).position,
        row * 3,
      );
    return out;
  };
  const first = flanges(a);
  const second = flanges(b);
  const apart = (i: number, k: number): number =>
    Math.hypot(
      first[3 * i]! - second[3 * k]!,
      first[3 * i + 1]! - second[3 * k + 1]!,
      first[3 * i + 2]! - second[3 * k + 2]!,
    );
  let apart_m = 0;
  let apartAt_s = 0;
  let sum_m = 0;
  let offPath_m = 0;
  for (let row = 0; row < rows; row++) {
    const here_m = apart(row, row);
    sum_m += here_m;
    if (here_m > apart_m) {
      apart_m = here_m;
      apartAt_s = row * a.period_s;
    }
    for (let i = 0; i < joints; i++)
      joints_rad[i] = Math.max(joints_rad[i]!, Math.abs(a.q_rad[row * joints + i]! - b.q_rad[row * joints + i]!));
  }
  for (let k = 0, by = Math.max(1, Math.ceil(b.rows / WAY_ROWS)); k < b.rows; k += by) {
    let nearest_m = Infinity;
    for (let i = 0; i + 1 < a.rows; i++) nearest_m = Math.min(nearest_m, toStretch(first, i, second, k));
    if (a.rows === 1) nearest_m = apart(0, k);
    offPath_m = Math.max(offPath_m, nearest_m);
  }
  return {
    longer_s: (b.rows - 1) * b.period_s - (a.rows - 1) * a.period_s,
    apart_m,
    apartAt_s,
    mean_m: rows > 0 ? sum_m / rows : 0,
    offPath_m,
    joints_rad,
  };
}

/** Distance of point k of `of` from the straight line between points i and i + 1 of `way`. */
function toStretch(way: Float64Array, i: number, of: Float64Array, k: number): number {
  let along = 0;
  let length2 = 0;
  for (let axis = 0; axis < 3; axis++) {
    const from = way[3 * i + axis]!;
    const step = way[3 * i + 3 + axis]! - from;
    along += (of[3 * k + axis]! - from) * step;
    length2 += step * step;
  }
  const part = length2 > 0 ? Math.min(1, Math.max(0, along / length2)) : 0;
  let away2 = 0;
  for (let axis = 0; axis < 3; axis++) {
    const from = way[3 * i + axis]!;
    away2 += (of[3 * k + axis]! - from - part * (way[3 * i + 3 + axis]! - from)) ** 2;
  }
  return Math.sqrt(away2);
}
