import { jerkOf } from "../model/jerk.ts";
import type { Robot } from "../model/robot.ts";
import { RoundedLaw } from "./rounded-law.ts";
import type { TimingGrid } from "./timing.ts";

/** Least share of the accelerations a slow run is left with. */
const SOFTEST = 0.2;

/**
 * Rounds the corners of a run's rate over a window of time long enough for the jerk that s̈ asks of each joint:
 *
 *   |q′ⱼ| |s̈(t) − s̈(t − w)| / w ≤ jⱼ
 *
 * The jerk is that of the motion along the path; what the bends of the path itself add is not in it.
 */
export class Rounder {
  readonly law = new RoundedLaw();
  /** The joint (from 1) whose jerk the last law uses most, its share of the limit, and the limit. */
  readonly worst = { joint: 1, load: 0, limit: 1 };
  /** Window that takes every joint from no acceleration to its full one within its jerk [s]. */
  private readonly window_s: number;
  private readonly jerks: Float64Array;
  private bends = new Float64Array(64);

  constructor(robot: Robot) {
    this.jerks = Float64Array.from(robot.arm.joints, ({ limits }) => jerkOf(limits));
    this.window_s = Math.max(...robot.arm.joints.map(({ limits }) => limits.acceleration_rad_s2 / jerkOf(limits)));
  }

  /**
   * From full acceleration straight to full deceleration takes twice the window that one of them takes from rest.
   *
   * @param softness  share of the accelerations in use: with less of it the window may be as much shorter.
   */
  round(grid: TimingGrid, x: Float64Array, softness: number): void {
    let window_s = this.window_s * softness;
    for (let turn = 0; turn < 3; turn++) {
      this.law.fill(grid.nodes, grid.s, x, window_s);
      this.measure(grid, x, window_s);
      if (this.worst.load <= 1 + 1e-3 || turn === 2) return;
      window_s = Math.min(2 * this.window_s, window_s * this.worst.load);
    }
  }

  /** Share of the accelerations with which ramp and window take equally long: √(v / (a w)), at most 1. */
  softness(grid: TimingGrid, x: Float64Array): number {
    let rate2 = 0;
    let bend = 0;
    for (let i = 0; i + 1 < grid.nodes; i++) {
      rate2 = Math.max(rate2, x[i]!);
      bend = Math.max(bend, Math.abs(this.bends[i]!));
    }
    return bend > 0 ? Math.max(SOFTEST, Math.min(1, Math.sqrt(Math.sqrt(rate2) / (bend * this.window_s)))) : 1;
  }

  private measure({ nodes, joints, q1 }: TimingGrid, x: Float64Array, window_s: number): void {
    const t = this.law.t;
    const last = nodes - 1;
    if (this.bends.length < nodes) this.bends = new Float64Array(Math.max(nodes, 2 * this.bends.length));
    const bends = this.bends;
    for (let i = 0; i < last; i++) {
      const h = t[i + 1]! - t[i]!;
      bends[i] = h > 0 ? (Math.sqrt(x[i + 1]!) - Math.sqrt(x[i]!)) / h : 0;
    }
    this.worst.load = 0;
    let back = 0;
    for (let i = 0; i < last; i++) {
      if (!(t[i + 1]! > t[i]!)) continue;
      while (back < i && t[back + 1]! <= t[i]! - window_s) back++;
      let change = t[i]! < window_s ? Math.abs(bends[i]!) : 0;
      for (let k = back; k <= i && t[k]! < t[i + 1]! - window_s; k++)
        change = Math.max(change, Math.abs(bends[i]! - bends[k]!));
      if (change > 0) this.note(i, change / window_s, joints, q1);
    }
    // Behind the end what is left of the deceleration goes.
    for (let k = back; k < last; k++) this.note(k, Math.abs(bends[k]!) / window_s, joints, q1);
  }

  private note(i: number, jerk: number, joints: number, q1: Float64Array): void {
    for (let j = 0; j < joints; j++) {
      const slope = Math.max(Math.abs(q1[i * joints + j]!), Math.abs(q1[(i + 1) * joints + j]!));
      const limit = this.jerks[j]!;
      if (slope * jerk > this.worst.load * limit) {
        this.worst.load = (slope * jerk) / limit;
        this.worst.joint = j + 1;
        this.worst.limit = limit;
      }
    }
  }
}
