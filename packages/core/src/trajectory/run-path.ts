import { armScratch, flangePose } from "../kinematics/forward.ts";
import type { Robot } from "../model/robot.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import { distance, type Vector3 } from "../spatial/vector.ts";
import { Follower } from "./follow.ts";
import {
  curvePath,
  geometryScratch,
  linePath,
  posePoint,
  poseTwist,
  TURN_M_PER_RAD,
  type Line,
  type PosePath,
} from "./geometry.ts";
import { GoalFinder, type Goal } from "./goal.ts";
import type { MoveStep } from "../program/program.ts";
import { HermitePath, type Stop } from "./hermite-path.ts";
import type { Move } from "./moves.ts";
import { posePathOf, SHORTEST_M } from "./pose-paths.ts";

/** Why a run of moves cannot be laid out: the move (counted from 0 within the run) and what stands in the way. */
export type RunStop =
  | { readonly kind: "goal"; readonly move: number; readonly goal: Extract<Goal, { kind: "none" }> }
  | { readonly kind: "path"; readonly move: number; readonly share: number; readonly stop: Stop }
  /** Joint counts from 1. */
  | {
      readonly kind: "limit";
      readonly move: number;
      readonly share: number;
      readonly joint: number;
      readonly wanted_rad: number;
      readonly limit_rad: number;
    }
  | { readonly kind: "straight-circle"; readonly move: number };

/**
 * A corner of a run, and all that lies between its sharp form and the widest one that it may be rounded to: the chords
 * from `u` of the widest way before its point to `u` of the widest way behind it, `u` from 0 (the point) to 1.
 */
export interface CornerSweep {
  /** The move that ends in the corner, counted from 0 within the run. */
  readonly move: number;
  /**
   * Postures along a chord, as many for each `u` [rad]; joints go straight from one to the next. undefined where the
   * arm does not get there without leaving its posture, as no controller does.
   */
  chord(u: number): readonly Float64Array[] | undefined;
}
/** What a corner may be rounded as, beside what its step says; the step is that before the corner. */
export type OtherCorners = (
  step: MoveStep,
  shorterWay_m: number,
) => readonly Pick<MoveStep, "blend_m" | "blend_ratio">[];

/** Steps in which the arm is followed from the point of a corner to where its widest form begins. */
const CORNER_STEPS = 4;
/** Postures on the chord of a corner of two TCP paths are so far apart at most [m]: joints between them go straight. */
const CHORD_NODES_M = 0.02;
const MOST_CHORD_NODES = 40;

/** Geometry of one move of a run. */
interface Leg {
  readonly move: Move;
  /** The TCP path; undefined for a joint move. */
  readonly path?: PosePath;
  /** Postures at both ends; only where a joint move is next to it. */
  q0?: Float64Array;
  q1?: Float64Array;
  readonly length: number;
}

/**
 * Joint path of moves that are passed without a stop: straight, circular and joint legs, with a corner curve of its own
 * between two legs where the first one blends. Between two TCP paths of the same tool the corner is a curve of the TCP
 * that leaves and joins them tangentially and stays inside the corner; next to a joint move it is a cubic in joint
 * space.
 */
export class RunPath {
  readonly path: HermitePath;
  private readonly robot: Robot;
  private readonly follower: Follower;
  private readonly goals: GoalFinder;
  private readonly scratch = geometryScratch();
  private readonly arm = armScratch();
  private readonly q: Float64Array;
  private startFlange: Pose<"base", "flange"> = identity();

  constructor(robot: Robot, tolerance_m: number) {
    this.robot = robot;
    this.follower = new Follower(robot.arm);
    this.goals = new GoalFinder(robot, this.follower);
    this.path = new HermitePath(this.follower, tolerance_m);
    this.q = new Float64Array(robot.arm.joints.length);
  }

  /** Fills `path` with the run from posture `q0`. When it stops, what `path` holds is of no use. */
  lay(moves: readonly Move[], q0: Float64Array): RunStop | undefined {
    this.path.clear();
    const legs: Leg[] = [];
    const stopped = this.layLegs(moves, q0, legs);
    if (stopped !== undefined) return stopped;
    const q = this.q;
    q.set(q0);
    let from = 0;
    for (let i = 0; i < legs.length; i++) {
      const leg = legs[i]!;
      const next = legs[i + 1];
      const smooth = next === undefined || this.smooth(leg, next);
      const corner = smooth ? { leave: leg.length, join: 0 } : this.corner(leg, next);
      if (corner.leave - from > SHORTEST_M || next === undefined) {
        const stop = this.layLeg(leg, from, corner.leave, q, i);
        if (stop !== undefined) return stop;
      }
      if (next !== undefined && !smooth) {
        const stop = this.layCorner(leg, next, corner.leave, corner.join, q, i);
        if (stop !== undefined) return stop;
      }
      from = corner.join;
    }
    return undefined;
  }

  private layLegs(moves: readonly Move[], q0: Float64Array, legs: Leg[]): RunStop | undefined {
    // Postures at the corners are only needed where a joint move ends or begins.
    let q: Float64Array | undefined = q0;
    this.startFlange = flangePose(this.robot.arm, q0, identity(), this.arm);
    for (let i = 0; i < moves.length; i++) {
      const move = moves[i]!;
      if (move.step.path === "ptp") {
        const start: Float64Array = q ?? q0;
        const goal = this.goals.find(move, start);
        if (goal.kind === "none") return { kind: "goal", move: i, goal };
        legs.push({ move, q0: start, q1: goal.q_rad, length: this.jointLength(start, goal.q_rad, move) });
        q = goal.q_rad;
        continue;
      }
      const path = posePathOf(moves, i, this.startFlange);
      if (path === undefined) return { kind: "straight-circle", move: i };
      const leg: Leg = { move, path, length: path.length };
      if (q !== undefined) leg.q0 = q;
      legs.push(leg);
      q = undefined;
      if (moves[i + 1]?.step.path === "ptp") {
        const end = this.march(leg, moves, i, legs, q0);
        if (end.kind === "stop") return { kind: "path", move: end.move, share: end.share, stop: end.stop };
        leg.q1 = q = end.q_rad;
      }
    }
    return undefined;
  }

  /** Posture at the end of a pose leg: along every pose leg since the last posture that is known. */
  private march(
    leg: Leg,
    moves: readonly Move[],
    i: number,
    legs: readonly Leg[],
    q0: Float64Array,
  ):
    | { readonly kind: "end"; readonly q_rad: Float64Array }
    | { readonly kind: "stop"; readonly move: number; readonly share: number; readonly stop: Stop } {
    let first = i;
    while (first > 0 && legs[first]!.q0 === undefined) first--;
    const q = (legs[first]?.q0 ?? q0).slice();
    const trial = new HermitePath(this.follower, Number.POSITIVE_INFINITY);
    for (let k = first; k <= i; k++) {
      const passed = k === i ? leg : legs[k]!;
      if (passed.path === undefined || passed.length < SHORTEST_M) continue;
      trial.clear();
      const stop = trial.addPoses(passed.path, moves[k]!.tcpFromFlange, 0, passed.length, q, k, k);
      if (stop !== undefined) return { kind: "stop", move: k, share: stop.s / passed.length, stop };
    }
    return { kind: "end", q_rad: q };
  }

  /** TCP distance along a joint move, so that its blends can be measured in metres. */
  private jointLength(q0: Float64Array, q1: Float64Array, move: Move): number {
    let way = 0;
    let turn = 0;
    const last: Vector3 = this.tcpAt(q0, q1, 0, move);
    for (let k = 1; k <= 8; k++) {
      const p = this.tcpAt(q0, q1, k / 8, move);
      way += distance(last, p);
      last[0] = p[0];
      last[1] = p[1];
      last[2] = p[2];
    }
    for (let j = 0; j < q0.length; j++) turn = Math.max(turn, Math.abs(q1[j]! - q0[j]!));
    return Math.max(way, TURN_M_PER_RAD * turn);
  }

  private tcpAt(q0: Float64Array, q1: Float64Array, share: number, move: Move): Vector3 {
    const q = q0.map((a, j) => a + (q1[j]! - a) * share);
    return compose(flangePose(this.robot.arm, q, identity(), this.arm), move.flangeFromTcp).position;
  }

  private smooth(leg: Leg, next: Leg): boolean {
    return (
      leg.move.step.path === "spline" &&
      next.move.step.path === "spline" &&
      leg.move.step.target.tool === next.move.step.target.tool &&
      leg.length >= SHORTEST_M &&
      next.length >= SHORTEST_M
    );
  }

  /**
   * The corners of a run with all that controllers may make of them; none where the run cannot be laid out. A corner
   * whose point the arm does not reach has no chords.
   *
   * @param ends_rad  postures near the points of the moves, one a move; where TCP paths meet, the arm is followed from
   *   there.
   */
  corners(
    moves: readonly Move[],
    q0: Float64Array,
    ends_rad: readonly Float64Array[],
    others: OtherCorners,
  ): CornerSweep[] {
    const legs: Leg[] = [];
    if (this.layLegs(moves, q0, legs) !== undefined) return [];
    const found: CornerSweep[] = [];
    for (let i = 0; i + 1 < legs.length; i++) {
      const leg = legs[i]!;
      const next = legs[i + 1]!;
      if (this.smooth(leg, next)) continue;
      const shorter_m = Math.min(this.chordOf(moves, i), this.chordOf(moves, i + 1));
      let { leave, join } = this.corner(leg, next);
      for (const other of others(leg.move.step, shorter_m)) {
        const wider = this.corner(leg, next, other);
        leave = Math.min(leave, wider.leave);
        join = Math.max(join, wider.join);
      }
      if (leg.length - leave <= SHORTEST_M && join <= SHORTEST_M) continue;
      const chord = this.chords(leg, next, leg.length - leave, join, ends_rad[i]!);
      found.push({ move: i, chord: chord ?? ((): undefined => undefined) });
    }
    return found;
  }

  /** From the point before a move to its own [m]. */
  private chordOf(moves: readonly Move[], i: number): number {
    const { flangeFromTcp, baseFromTcp } = moves[i]!;
    return distance(
      compose(moves[i - 1]?.baseFromFlange ?? this.startFlange, flangeFromTcp).position,
      baseFromTcp.position,
    );
  }

  private chords(
    leg: Leg,
    next: Leg,
    before: number,
    behind: number,
    near_rad: Float64Array,
  ): CornerSweep["chord"] | undefined {
    const corner = (leg.q1 ?? next.q0 ?? near_rad).slice();
    if (leg.path !== undefined && !this.path.reach(leg.path, leg.move.tcpFromFlange, leg.length, corner))
      return undefined;
    const along = (of: Leg, from: number, to: number): Float64Array | undefined => {
      if (of.path === undefined) return this.onJointLeg(of, to);
      const q = corner.slice();
      for (let k = 0; k <= CORNER_STEPS; k++) {
        const s = from + ((to - from) * k) / CORNER_STEPS;
        if (!this.path.reach(of.path, of.move.tcpFromFlange, s, q)) return undefined;
      }
      return q;
    };
    const sameTool = leg.move.step.target.tool === next.move.step.target.tool;
    const tcpChord =
      leg.path === undefined || next.path === undefined || !sameTool
        ? undefined
        : (u: number): Line => {
            const a: Pose = identity();
            const b: Pose = identity();
            posePoint(leg.path!, leg.length - u * before, a, this.scratch);
            posePoint(next.path!, u * behind, b, this.scratch);
            return linePath(a, b);
          };
    const pieces =
      tcpChord === undefined
        ? 1
        : Math.min(MOST_CHORD_NODES, Math.max(1, Math.ceil(tcpChord(1).length / CHORD_NODES_M)));
    return u => {
      const a = along(leg, leg.length, leg.length - u * before);
      const b = along(next, 0, u * behind);
      if (a === undefined || b === undefined) return undefined;
      if (tcpChord === undefined) return [a, b];
      const line = tcpChord(u);
      const nodes = [a];
      const q = a.slice();
      for (let k = 1; k < pieces; k++) {
        if (!this.path.reach(line, leg.move.tcpFromFlange, (line.length * k) / pieces, q)) return undefined;
        nodes.push(q.slice());
      }
      nodes.push(b);
      return nodes;
    };
  }

  /**
   * How far along each leg its corner begins and ends. Half of a leg at most, so that two corners never meet.
   *
   * @param as  how it is rounded; as the step says without it.
   */
  private corner(
    leg: Leg,
    next: Leg,
    as: Pick<MoveStep, "blend_m" | "blend_ratio"> = leg.move.step,
  ): { readonly leave: number; readonly join: number } {
    const { blend_m: blend, blend_ratio: ratio = 0 } = as;
    // A move to where the robot stands has no direction a curve could leave in.
    if (leg.length <= SHORTEST_M || next.length <= SHORTEST_M) return { leave: leg.length, join: 0 };
    if (leg.path !== undefined && next.path !== undefined) {
      const half = Math.min(leg.length, next.length) / 2;
      const d = ratio > 0 ? ratio * half : Math.min(blend, half);
      return { leave: leg.length - d, join: d };
    }
    if (ratio > 0) return { leave: leg.length * (1 - ratio / 2), join: (next.length * ratio) / 2 };
    return { leave: leg.length - this.withinBlend(leg, blend, true), join: this.withinBlend(next, blend, false) };
  }

  /** Longest way from a leg's corner, up to half of it, that keeps the TCP within `blend` of the corner. */
  private withinBlend(leg: Leg, blend: number, atEnd: boolean): number {
    const half = leg.length / 2;
    if (leg.path !== undefined || leg.q0 === undefined || leg.q1 === undefined) return Math.min(blend, half);
    const corner = this.tcpAt(leg.q0, leg.q1, atEnd ? 1 : 0, leg.move);
    let low = 0;
    let high = 0.5;
    for (let k = 0; k < 24; k++) {
      const share = k === 0 ? high : (low + high) / 2;
      if (distance(this.tcpAt(leg.q0, leg.q1, atEnd ? 1 - share : share, leg.move), corner) <= blend) {
        low = share;
        if (k === 0) break;
      } else high = share;
    }
    return low * leg.length;
  }

  private layLeg(leg: Leg, from: number, to: number, q: Float64Array, i: number): RunStop | undefined {
    if (leg.path !== undefined) {
      if (to - from <= SHORTEST_M) return undefined;
      const stop = this.path.addPoses(leg.path, leg.move.tcpFromFlange, from, to, q, i, i);
      return stop === undefined ? undefined : { kind: "path", move: i, share: stop.s / leg.length, stop };
    }
    if (leg.length <= SHORTEST_M * 1e-3) return undefined;
    const a = this.onJointLeg(leg, from);
    const b = this.onJointLeg(leg, to);
    const d = this.jointSlope(leg);
    this.path.addJoints(a, d, b, d, to - from, i, i);
    q.set(b);
    return undefined;
  }

  private layCorner(leg: Leg, next: Leg, leave: number, join: number, q: Float64Array, i: number): RunStop | undefined {
    const length = leg.length - leave + join;
    if (length <= 2 * SHORTEST_M) return undefined;
    if (leg.path !== undefined && next.path !== undefined && leg.move.step.target.tool === next.move.step.target.tool) {
      const a: Pose = identity();
      const b: Pose = identity();
      const t0 = new Float64Array(6);
      const t1 = new Float64Array(6);
      posePoint(leg.path, leave, a, this.scratch);
      poseTwist(leg.path, leave, t0, this.scratch);
      posePoint(next.path, join, b, this.scratch);
      poseTwist(next.path, join, t1, this.scratch);
      const curve = curvePath(a, t0, b, t1, length);
      const stop = this.path.addPoses(curve, next.move.tcpFromFlange, 0, length, q, i, i + 1);
      return stop === undefined
        ? undefined
        : { kind: "path", move: stop.s < length / 2 ? i : i + 1, share: stop.s < length / 2 ? 1 : 0, stop };
    }
    const d0 = this.slopeAt(leg, leave, q);
    const end = this.postureAt(next, join, leg.q1 ?? q);
    if (end === undefined)
      return {
        kind: "path",
        move: i + 1,
        share: join / next.length,
        stop: { kind: "out-of-reach", s: join, goal: next.move.baseFromFlange },
      };
    this.path.addJoints(q, d0, end, this.slopeAt(next, join, end), length, i, i + 1);
    q.set(end);
    return undefined;
  }

  private slopeAt(leg: Leg, s: number, q: Float64Array): Float64Array {
    if (leg.path === undefined) return this.jointSlope(leg);
    const out = new Float64Array(q.length);
    this.path.slope(leg.path, leg.move.tcpFromFlange, s, q, out);
    return out;
  }

  private postureAt(leg: Leg, s: number, near: Float64Array): Float64Array | undefined {
    if (leg.path === undefined) return this.onJointLeg(leg, s);
    const q = near.slice();
    for (let k = 1; k <= 4; k++)
      if (!this.path.reach(leg.path, leg.move.tcpFromFlange, (s * k) / 4, q)) return undefined;
    return q;
  }

  private onJointLeg(leg: Leg, s: number): Float64Array {
    const q0 = leg.q0!;
    const q1 = leg.q1!;
    return q0.map((a, j) => a + ((q1[j]! - a) * s) / leg.length);
  }

  private jointSlope(leg: Leg): Float64Array {
    const q0 = leg.q0!;
    const q1 = leg.q1!;
    return q0.map((a, j) => (q1[j]! - a) / leg.length);
  }
}
