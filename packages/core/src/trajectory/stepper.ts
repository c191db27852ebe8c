import { jerkOf } from "../model/jerk.ts";
import type { Robot } from "../model/robot.ts";
import { blends, resolveMove, passes, type PlanContext } from "./moves.ts";
import type { MotionSegment as Motion, Segment } from "./plan.ts";
import { GRIPPER_S } from "./planner.ts";
import { RunPlanner } from "./run.ts";
import { intervalAccelerations, sampleSegment, segmentKnot } from "./sample.ts";
import { explainStop, type Stuck } from "./stop.ts";
import type { Signals } from "../signals.ts";
import type { MoveStep, PayloadStep, Step, WaitForStep } from "../program/program.ts";
import { Pulses } from "../program/pulses.ts";
import { predicateWords } from "../program/predicate.ts";
import { SignalTable, holds } from "../program/signals.ts";

/** What the stepper is doing after an `advance`. Lent until the next call. */
export interface StepperState {
  /**
   * "running" while there are steps; "done" after the last; "stopped" after `stop`; "fault" when a step cannot be
   * carried out.
   */
  kind: "running" | "done" | "stopped" | "fault";
  /** Id of the step being executed, or "". */
  step: string;
  moving: boolean;
  gripperClosed: boolean;
  /** Rate of the path, 0 … 1: follows the override as fast as the accelerations allow. */
  rate: number;
  /** What the program last said to whoever stands at the robot, or "". */
  message: string;
  /** What the flange carries since the last payload step. */
  payload: PayloadStep | undefined;
  /** Why, when `kind` is "fault". */
  fault: Stuck | undefined;
}

export interface StepperOptions {
  readonly gripperClosed?: boolean;
  readonly gripper_s?: number;
  /** The lines that steps write and wait for; when left out they only remember what is written. */
  readonly signals?: Signals;
}

/** Whether the next step decides about a stop. */
const goesOn = (step: MoveStep): boolean => step.until === undefined && (blends(step) || step.path === "spline");

/** A rate this near to the wanted one is the wanted one. */
const LAST_OF_RATE = 1e-6;

/** Moves looked ahead over blends. A longer run of blended moves stops once at its end. */
const MOST_AHEAD = 64;

/**
 * Executes neutral steps one after the other, a slice of time per call: the engine of virtual controllers and of
 * interpreted program text. Steps are taken from the iterator when they are needed: the one being executed, and as many
 * more as are passed without a stop, so that a list changed behind the iterator takes effect at the next stop (T-53).
 *
 * The override scales time along the path and never changes the path; waits take their own seconds at any override
 * above 0. A change of override and `stop` slow the arm down along the path within its joint accelerations and jerks.
 *
 * Signals are looked at once a slice. A search slows down where its condition comes true and goes on with the next step
 * from where it then stands. Steps are primitive (`unrolled` makes them so); comments are passed over.
 */
export class Stepper {
  readonly robot: Robot;
  private readonly context: PlanContext;
  private readonly steps: Iterator<Step, unknown>;
  private readonly planner: RunPlanner;
  private readonly gripper_s: number;
  private readonly state: StepperState;
  private readonly q: Float64Array;
  private readonly qd: Float64Array;
  private readonly bend: Float64Array;
  private readonly most: Float64Array;
  private readonly least: Float64Array;
  private readonly signals: Signals;
  private readonly pulses: Pulses;
  private waiting: Step | undefined = undefined;
  private waitFor: WaitForStep | undefined = undefined;
  /** The search under way: always the last move of its run. */
  private search: MoveStep | undefined = undefined;
  private found = false;
  private segments: readonly Segment[] = [];
  private segment = 0;
  private t_s = 0;
  private stopping = false;
  private hard = false;
  /** How fast the rate changes [1/s]. */
  private change = 0;
  private ended = false;
  private faultBehind: Stuck | undefined = undefined;

  /**
   * @param q0  posture at the start, at rest; copied.
   */
  constructor(
    robot: Robot,
    context: PlanContext,
    steps: Iterable<Step> | Iterator<Step, unknown>,
    q0: ArrayLike<number>,
    options: StepperOptions = {},
  ) {
    this.robot = robot;
    this.context = context;
    this.steps = Symbol.iterator in steps ? steps[Symbol.iterator]() : steps;
    this.planner = new RunPlanner(robot);
    this.gripper_s = options.gripper_s ?? GRIPPER_S;
    this.signals = options.signals ?? new SignalTable();
    this.pulses = new Pulses(this.signals);
    this.q = Float64Array.from(q0);
    this.qd = new Float64Array(this.q.length);
    this.bend = new Float64Array(2 * this.q.length);
    this.most = new Float64Array(this.q.length);
    this.least = new Float64Array(this.q.length);
    this.state = {
      kind: "running",
      step: "",
      moving: false,
      gripperClosed: options.gripperClosed ?? false,
      rate: 0,
      message: "",
      payload: undefined,
      fault: undefined,
    };
  }

  /**
   * Goes on by `dt_s` of the caller's time.
   *
   * @param override  0 … 1; 0 holds the arm where it is on its path.
   * @param outQ      receives the joint angles [rad].
   */
  advance(dt_s: number, override: number, outQ: Float64Array): StepperState {
    const state = this.state;
    const wanted = this.stopping ? 0 : Math.min(1, Math.max(0, override));
    let left_s = dt_s;
    this.pulses.advance(dt_s);
    // The bound only guards against an iterator that yields steps of no duration for ever.
    for (let turn = 0; left_s > 0 && state.kind === "running" && turn < MOST_AHEAD; turn++) {
      const segment = this.segments[this.segment];
      if (segment === undefined) {
        if (this.ended) {
          this.end();
          break;
        }
        // Nothing is begun while the arm is held.
        if (this.stopping) {
          state.kind = "stopped";
          break;
        }
        if (wanted === 0) break;
        this.next();
        this.change = 0;
        state.rate = wanted; // From rest the rate is free: nothing moves yet.
        continue;
      }
      state.step = segment.step;
      if (segment.kind === "rest") {
        left_s = this.rest(segment, wanted, left_s);
        continue;
      }
      if (this.searching(segment) && this.stands()) continue;
      left_s = this.follow(segment, this.found ? 0 : wanted, left_s);
    }
    state.moving = state.kind === "running" && state.rate > 0 && this.segments[this.segment]?.kind === "motion";
    outQ.set(this.q);
    return state;
  }

  /**
   * Slows down along the path and ends there; the steps that are left are not executed.
   *
   * @param hard  as fast as the accelerations allow, without sparing the gears: for emergencies.
   */
  stop(hard = false): void {
    this.stopping = true;
    this.hard ||= hard;
  }

  /** Posture the arm has reached; lent. */
  get posture(): Float64Array {
    return this.q;
  }

  /** Stands for up to `left_s`; returns what is left of it, 0 where the arm is held, or waits on. */
  private rest(segment: Extract<Segment, { kind: "rest" }>, wanted: number, left_s: number): number {
    const state = this.state;
    state.gripperClosed = segment.gripperClosed;
    state.rate = wanted;
    if (this.stopping) {
      state.kind = "stopped";
      return 0;
    }
    if (wanted === 0) return 0;
    if (this.waitFor !== undefined && !this.met(this.waitFor, left_s)) return 0;
    const rest_s = segment.duration_s - this.t_s;
    if (left_s < rest_s) {
      this.t_s += left_s;
      return 0;
    }
    this.leave();
    return left_s - rest_s;
  }

  /** Plays a motion for up to `left_s`; returns what is left of it. */
  private follow(segment: Motion, wanted: number, left_s: number): number {
    const state = this.state;
    const before = state.rate;
    const rate = this.nextRate(segment, wanted, left_s);
    const mean = (before + rate) / 2;
    const end_s = segment.duration_s - this.t_s;
    if (mean * left_s >= end_s) {
      const used_s = mean > 0 ? end_s / mean : 0;
      state.rate = before + (rate - before) * (left_s > 0 ? used_s / left_s : 1);
      sampleSegment(segment, segment.duration_s, this.q);
      this.leave();
      return left_s - used_s;
    }
    this.t_s += mean * left_s;
    state.rate = rate;
    sampleSegment(segment, this.t_s, this.q);
    if (rate === 0 && this.stopping) state.kind = "stopped";
    return 0;
  }

  /** Whether the wait is over; a slice of it passes when it is not. */
  private met(step: WaitForStep, left_s: number): boolean {
    if (holds(step.when, this.signals)) {
      this.waitFor = undefined;
      this.t_s = 0;
      return true;
    }
    this.t_s += left_s;
    if (step.timeout_s !== undefined && this.t_s >= step.timeout_s - 1e-9) {
      // The program says what is done then.
      if (step.late !== undefined) {
        this.waitFor = undefined;
        this.t_s = 0;
        return true;
      }
      this.fail({
        step: step.id,
        code: "signals.timeout",
        sentence: `Step “${step.id}” waited ${step.timeout_s} s for ${predicateWords(step.when)}.`,
        hint: "Look why the signal did not come, or give it more time.",
      });
    }
    return false;
  }

  private searching(segment: Segment): boolean {
    return this.search !== undefined && segment.step === this.search.id && this.segment + 1 === this.segments.length;
  }

  /** Looks for what the search looks for. True when the robot stands where it was found. */
  private stands(): boolean {
    this.found ||= holds(this.search!.until!.when, this.signals);
    const begun = this.segment > 0 || this.t_s > 0;
    if (!this.found || this.stopping || (begun && this.state.rate > 0)) return false;
    this.search = undefined;
    this.segments = [];
    return true;
  }

  private fail(fault: Stuck): void {
    this.state.kind = "fault";
    this.state.fault = fault;
  }

  /**
   * The rate after dt on its way to `wanted`:
   *   |q̈ λ² + q̇ λ̇| ≤ a and |q̇ λ̈| ≤ j for every joint.
   * λ̇ = 0 is always allowed,
   * because the plan itself keeps the limits; where both rules cannot be kept, the acceleration is.
   */
  private nextRate(segment: Motion, wanted: number, dt_s: number): number {
    const rate = this.state.rate;
    const n = this.q.length;
    if (rate === wanted) {
      this.change = 0;
      return wanted;
    }
    sampleSegment(segment, this.t_s, this.q, this.qd);
    // What the plan itself asks for within this slice: at its start, and in every interval it enters.
    const reach_s = this.t_s + Math.max(rate, wanted) * dt_s;
    const first = segmentKnot(segment, this.t_s);
    const times = segment.times_s;
    this.most.fill(Number.NEGATIVE_INFINITY);
    this.least.fill(Number.POSITIVE_INFINITY);
    for (let i = first; i + 1 < times.length && times[i]! <= reach_s; i++) this.seeBends(segment, i, this.t_s, reach_s);
    const next = this.segments[this.segment + 1];
    if (reach_s > segment.duration_s && next?.kind === "motion" && next.times_s.length > 1)
      this.seeBends(next, 0, 0, reach_s - segment.duration_s);
    let most = Number.POSITIVE_INFINITY;
    let jerk = Number.POSITIVE_INFINITY;
    for (let j = 0; j < n; j++) {
      const limits = this.robot.arm.joints[j]!.limits;
      // The speed may still grow within the slice.
      const speed = this.qd[j]!;
      const growth = Math.max(0, speed > 0 ? this.most[j]! : -this.least[j]!);
      const fastest = Math.abs(speed) + growth * (reach_s - this.t_s);
      if (fastest < 1e-9) continue;
      // λ̇ adds q̇ λ̇: what is left of the limit on the side it pushes to.
      const forward = wanted > rate === speed > 0;
      const bend = (forward ? this.most[j]! : -this.least[j]!) * rate * rate;
      most = Math.min(most, Math.max(0, limits.acceleration_rad_s2 - bend) / fastest);
      jerk = Math.min(jerk, jerkOf(limits) / fastest);
    }
    const up = wanted > rate ? 1 : -1;
    const left = Math.abs(wanted - rate);
    // Slow enough to come to λ̇ = 0 at `wanted`, with steps of dt.
    const arriving =
      this.hard || jerk === Number.POSITIVE_INFINITY
        ? Number.POSITIVE_INFINITY
        : Math.sqrt((jerk * dt_s) ** 2 / 4 + 2 * jerk * left) - (jerk * dt_s) / 2;
    const ramped = this.hard ? Number.POSITIVE_INFINITY : up * this.change + jerk * dt_s;
    this.change = up * Math.min(most, arriving, ramped);
    const step = Math.abs(this.change) * dt_s;
    // A change that still goes the other way is taken back first.
    if (up * this.change <= 0) return Math.min(1, Math.max(0, rate + this.change * dt_s));
    if (step >= left || left - step < LAST_OF_RATE) {
      this.change = 0;
      return wanted;
    }
    return rate + up * step;
  }

  /** Widens `most` and `least` by the accelerations of one interval of a plan from one instant to another. */
  private seeBends(segment: Motion, i: number, from_s: number, to_s: number): void {
    const n = this.q.length;
    const t0 = segment.times_s[i]!;
    const h = segment.times_s[i + 1]! - t0;
    intervalAccelerations(segment, i, n, this.bend);
    const u = h > 0 ? Math.max(0, (from_s - t0) / h) : 0;
    const v = h > 0 ? Math.min(1, (to_s - t0) / h) : 1;
    for (let j = 0; j < n; j++) {
      const begin = this.bend[j]!;
      const slope = this.bend[n + j]! - begin;
      const a = begin + slope * u;
      const b = begin + slope * v;
      this.most[j] = Math.max(this.most[j]!, a, b);
      this.least[j] = Math.min(this.least[j]!, a, b);
    }
  }

  private leave(): void {
    this.segment++;
    this.t_s = 0;
    if (this.segment < this.segments.length) return;
    if (this.faultBehind !== undefined) {
      this.fail(this.faultBehind);
      return;
    }
    const { search } = this;
    this.search = undefined;
    if (search?.until?.missing !== "fault" || this.found || holds(search.until.when, this.signals)) return;
    this.fail({
      step: search.id,
      code: "search.missing",
      sentence: `The search of step “${search.id}” came to its end without the signal “${search.until.when.signal}”.`,
      hint: "Look at the sensor, or let the search go further.",
    });
  }

  private take(): Step | undefined {
    const step = this.waiting;
    this.waiting = undefined;
    if (step !== undefined) return step;
    const next = this.steps.next();
    return next.done === true ? undefined : next.value;
  }

  /** Lays out the next rest or run of moves. */
  private next(): void {
    const step = this.take();
    this.segments = [];
    this.segment = 0;
    this.t_s = 0;
    if (step === undefined) {
      this.end();
      return;
    }
    if (step.type !== "move") {
      this.begin(step);
      return;
    }
    const run: MoveStep[] = [step];
    while (run.length < MOST_AHEAD && goesOn(run.at(-1)!)) {
      const next = this.take();
      if (next?.type === "move" && passes(run.at(-1)!, next)) {
        run.push(next);
        continue;
      }
      this.waiting = next;
      break;
    }
    this.layOut(run);
  }

  /** The end waits for pulses that are still running. */
  private end(): void {
    this.ended = true;
    this.state.step = "";
    if (!this.pulses.pending) this.state.kind = "done";
  }

  /** What is not a move: done at once, or a rest. */
  private begin(step: Exclude<Step, MoveStep>): void {
    const { state } = this;
    let duration_s = 0;
    switch (step.type) {
      case "wait":
        duration_s = step.s;
        break;
      case "gripper":
        duration_s = this.gripper_s;
        break;
      case "wait-for":
        this.waitFor = step;
        break;
      case "set":
        this.pulses.set(step);
        break;
      case "message":
        state.message = step.text;
        break;
      case "payload":
        state.payload = step;
        break;
      case "comment":
        return;
      case "stop":
        this.end();
        return;
      case "assign":
      case "call":
      case "repeat":
      case "while":
      case "if":
      case "pallet":
        state.step = step.id;
        this.fail({
          step: step.id,
          code: "program.block",
          sentence: `Step “${step.id}” is of type ${step.type}, which only its program can carry out.`,
          hint: "Hand over the program's unrolled steps.",
        });
        return;
    }
    this.segments = [
      {
        kind: "rest",
        step: step.id,
        start_s: 0,
        duration_s,
        q_rad: this.q.slice(),
        gripperClosed: step.type === "gripper" ? step.closed : state.gripperClosed,
      },
    ];
  }

  private layOut(run: readonly MoveStep[]): void {
    const last = run.at(-1)!;
    this.search = last.until === undefined ? undefined : last;
    this.found = false;
    const moves = run.map(step => resolveMove(step, this.robot, this.context));
    const answer = this.planner.plan(moves, this.q);
    if (answer.kind === "timed") {
      this.segments = answer.run.parts;
      return;
    }
    // What comes before the step in the way is still done, with a stop at its end.
    const at = answer.stop.move;
    const before = at > 0 ? this.planner.plan(moves.slice(0, at), this.q) : undefined;
    this.faultBehind = explainStop(answer.stop, moves[at]!, this.robot);
    if (before?.kind === "timed") {
      this.segments = before.run.parts;
      return;
    }
    this.state.kind = "fault";
    this.state.step = moves[at]!.step.id;
    this.state.fault = this.faultBehind;
  }
}
