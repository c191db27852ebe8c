import {
  jointsOfAxes,
  type JointSample,
  type OperatingMode,
  type SafetyState,
  type AxisCounting,
} from "@twincell/core";
import { AXES, AXIS_NAMES } from "../codec/axes.ts";
import type { C3Item } from "../codec/c3-replies.ts";
import { boolIn, enumIn, numberIn, partsIn, textIn } from "../codec/values.ts";
import { TWC } from "../codec/loop.ts";

/**
 * Read in every poll, one after the other in this order: whether a motion ended before where the robot stands. The
 * lines in and out that somebody wants to see follow.
 */
export const POLLED: readonly string[] = [
  TWC.done,
  TWC.command,
  "$MODE_OP",
  "$PRO_STATE1",
  "$PRO_NAME1[]",
  "$OV_PRO",
  "$PERI_RDY",
  "$STOPMESS",
  "$ALARM_STOP",
  "$USER_SAF",
  "$ROB_TIMER",
  "$AXIS_ACT",
  TWC.result,
  TWC.lock,
];
/** The timer of the controller counts to 2³¹ − 1 ms and begins again. */
const TIMER_TURN_MS = 0x80000000;
const NEAR_TURN_MS = 60_000;
/** An axis that moved by less between two polls stands: above the rounding of printed numbers. */
const STANDS_DEG = 2e-4;

type State = { -readonly [K in keyof Omit<JointSample, "step">]: Omit<JointSample, "step">[K] };

/** What the controller said in its last answer, and the sample it amounts to. */
export class KukaState {
  readonly sample: State;
  mode = "";
  program = "";
  programState = "";
  ready = false;
  command = 0;
  done = 0;
  result = 0;
  private readonly own: string;
  private readonly axes: AxisCounting;
  private readonly lines: readonly string[];
  private readonly gripper: string;
  private readonly values = new Map<string, boolean | number>();
  private readonly a_deg = new Float64Array(AXES).fill(NaN);
  private readonly before_deg = new Float64Array(AXES);
  private turns = 0;
  private timer_ms = NaN;

  /** @param own  the program that moves the robot for us. @param gripper  the line the gripper hangs on, or "". */
  constructor(own: string, axes: AxisCounting, lines: readonly string[], gripper: string) {
    this.own = own;
    this.axes = axes;
    this.lines = lines;
    this.gripper = gripper;
    this.sample = {
      sequence: 0,
      time_s: 0,
      q_rad: new Float64Array(AXES),
      moving: false,
      mode: "automatic",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      message: "",
      signals: this.values,
    };
  }
  get loopRuns(): boolean {
    return this.program === this.own && this.programState === "P_ACTIVE";
  }

  /**
   * @param now_s  the time here, for a controller that has no timer.
   * @returns whether it is a new state: a controller whose clock stands still says nothing new. Null when an axis or a
   *   state cannot be read.
   */
  take(items: readonly C3Item[], now_s: number): boolean | null {
    const text = (i: number): string => (items[i]?.error === 1 ? items[i].value : "");
    this.before_deg.set(this.a_deg);
    if (!partsIn(text(11), AXIS_NAMES, this.a_deg)) return null;
    const timer_ms = numberIn(text(10));
    if (timer_ms === this.timer_ms) return false;
    if (timer_ms < this.timer_ms && this.timer_ms > TIMER_TURN_MS - NEAR_TURN_MS) this.turns++;
    else if (timer_ms < this.timer_ms) this.turns = 0;
    this.timer_ms = timer_ms;
    const { sample } = this;
    this.mode = enumIn(text(2));
    this.programState = enumIn(text(3));
    if (this.mode === "" || this.programState === "") return null;
    this.program = textIn(text(4));
    this.ready = boolIn(text(6)) === true;
    this.command = numberIn(text(1));
    this.done = numberIn(text(0));
    this.result = numberIn(text(12));
    this.lines.forEach((line, i) => {
      const said = text(POLLED.length + i);
      const bool = boolIn(said);
      if (said !== "") this.values.set(line, bool ?? numberIn(said));
    });
    sample.sequence++;
    sample.time_s = Number.isNaN(timer_ms) ? now_s : (timer_ms + this.turns * TIMER_TURN_MS) / 1000;
    jointsOfAxes(this.axes, this.a_deg, sample.q_rad);
    sample.mode = MODES[this.mode] ?? "manual";
    sample.override = numberIn(text(5)) / 100;
    sample.safety = safetyOf(
      boolIn(text(8)) === false,
      boolIn(text(13)) === true,
      boolIn(text(9)) === false && sample.mode !== "manual",
      boolIn(text(7)) === true,
    );
    sample.moving = (this.command !== this.done && this.loopRuns && sample.override > 0) || this.moved();
    sample.gripperClosed = this.values.get(this.gripper) === true;
    sample.message =
      WORDS[sample.safety] ||
      (boolIn(text(13)) === true ? "" : this.ready || sample.mode === "manual" ? "" : "The drives are off.");
    return true;
  }
  private moved(): boolean {
    for (let i = 0; i < AXES; i++) if (Math.abs(this.a_deg[i]! - this.before_deg[i]!) > STANDS_DEG) return true;
    return false;
  }
}
const MODES: Readonly<Record<string, OperatingMode>> = { T1: "manual", T2: "manual", AUT: "automatic", EX: "remote" };
const WORDS: Readonly<Record<SafetyState, string>> = {
  normal: "",
  "emergency-stop": "The emergency stop is on.",
  "guard-stop": "The operator safety is open.",
  "protective-stop": "The robot stopped; a message on its pendant waits to be confirmed.",
};

function safetyOf(alarm: boolean, locked: boolean, open: boolean, stopMessage: boolean): SafetyState {
  if (alarm || locked) return "emergency-stop";
  if (open) return "guard-stop";
  return stopMessage ? "protective-stop" : "normal";
}
