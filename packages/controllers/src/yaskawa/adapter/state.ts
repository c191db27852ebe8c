import type { JointSample, OperatingMode, Robot, SafetyState } from "@twincell/core";
import {
  noPosition,
  noStatus,
  radiansOf,
  readPosition,
  readStatus,
  type Position,
  type PulseScale,
  type Status,
} from "../codec/index.ts";
import { standsBecause } from "./words.ts";

type Lent = { -readonly [K in keyof Omit<JointSample, "step">]: JointSample[K] };

/** What is known of the robot, rewritten in place by every answer. */
export interface RobotState {
  readonly status: Status;
  readonly position: Position;
  readonly sample: Lent & { readonly signals: Map<string, boolean | number> };
  /** Alarm as the controller names it, or "". */
  alarm: string;
  /** Line of the job being executed, or "". */
  job: string;
  /** The override that is set at the pendant. */
  pendantOverride: number;
  takeStatus(data: Uint8Array): boolean;
  /** Pulses into angles; completes the sample. */
  takePosition(data: Uint8Array, now_s: number, ratio: number, emergency: boolean): boolean;
}

export function robotState(robot: Robot, scale: PulseScale): RobotState {
  const status = noStatus();
  const position = noPosition();
  const before = new Int32Array(position.axes.length);
  const q_rad = Float64Array.from(robot.home_rad);
  const sample = {
    sequence: 0,
    time_s: 0,
    q_rad,
    moving: false,
    mode: "automatic" as OperatingMode,
    safety: "normal" as SafetyState,
    override: 1,
    gripperClosed: false,
    message: "",
    signals: new Map<string, boolean | number>(),
  };
  const state: RobotState = {
    status,
    position,
    sample,
    alarm: "",
    job: "",
    pendantOverride: 1,
    takeStatus: data => readStatus(data, status),
    takePosition(data, now_s, ratio, emergency) {
      before.set(position.axes);
      if (!readPosition(data, position)) return false;
      radiansOf(position.axes, scale, robot, q_rad);
      sample.sequence++;
      sample.time_s = now_s;
      // With the pendant the robot moves without a job: then only its position says so.
      sample.moving = status.running || (status.teach && position.axes.some((pulses, i) => pulses !== before[i]));
      sample.mode = status.teach ? "manual" : status.remote ? "remote" : "automatic";
      sample.safety = safetyOf(status, emergency);
      sample.override = ratio * state.pendantOverride;
      sample.message =
        state.alarm !== ""
          ? state.alarm
          : sample.safety !== "normal" || status.heldByPendant
            ? (standsBecause(status) ?? "")
            : "";
      return true;
    },
  };
  return state;
}

/** @param emergency  was commanded from here and not reset yet. */
function safetyOf(status: Status, emergency: boolean): SafetyState {
  if (emergency || (!status.servo && status.error)) return "emergency-stop";
  if (status.alarm) return "protective-stop";
  if (status.heldOutside) return "guard-stop";
  // Without drives nothing moves until a reset, which turns them on.
  return status.servo ? "normal" : "emergency-stop";
}
