import {
  robotById,
  type JointSample,
  type Robot,
  type Scheduler,
  type StateSource,
  type Timeline,
} from "@twincell/core";
import type { Packing } from "./packing.ts";
import { readRecording, type RecordingData } from "./read.ts";
import type { RunEvent } from "./state.ts";

/** A run looked back at: the same door as a live robot, with a timeline. Times count from the first sample. */
export interface RecordedRun extends StateSource {
  readonly timeline: Timeline;
  readonly data: RecordingData;
  readonly events: readonly RunEvent[];
  readonly duration_s: number;
  /** Where the timeline stands now. */
  readonly position_s: number;
  readonly playing: boolean;
  /**
   * Joint angles at that time; allocates nothing.
   *
   * @param between  "hold": those of the last sample. "interpolate": on the straight line to the next one, unless the
   *                 two are further apart than a gap in the recording.
   * @param out      receives them and is returned.
   */
  anglesAt(at_s: number, out: Float64Array, between?: "hold" | "interpolate"): Float64Array;
}
export type Opened =
  | { readonly kind: "recording"; readonly recording: RecordedRun }
  | { readonly kind: "not-a-recording"; readonly sentence: string };

export interface OpenOptions {
  /** Needed to play; seeking works without. */
  readonly scheduler: Scheduler;
  /** Unpacks compact recordings. */
  readonly packing?: Packing;
  /** Finds the robot of that id. */
  readonly robot?: (id: string) => Robot | undefined;
}

/** Opens a recorded run; one that was cut off or damaged opens with what is left of it. */
export function openRecording(bytes: Uint8Array, options: OpenOptions): Opened {
  const read = readRecording(bytes, options.packing);
  return read.kind === "read" ? playable(read.data, options) : read;
}

/** Makes recording data, read here or in a worker, into a source of samples. */
export function playable(data: RecordingData, options: OpenOptions): Opened {
  const robot = (options.robot ?? robotById)(data.robot);
  if (!robot)
    return {
      kind: "not-a-recording",
      sentence: `The recording is of ${data.robotName || data.robot}, a robot that is not known here.`,
    };
  if (robot.arm.joints.length !== data.joints) {
    return {
      kind: "not-a-recording",
      sentence: `The recording has ${data.joints} joints; ${robot.name} has ${robot.arm.joints.length}.`,
    };
  }
  return { kind: "recording", recording: recordedRun(data, robot, options.scheduler) };
}

const GAP_S = 0.25;
const FRAME_S = 1 / 60;
type Lent = { -readonly [K in keyof JointSample]: JointSample[K] };

function recordedRun(data: RecordingData, robot: Robot, scheduler: Scheduler): RecordedRun {
  const { times_s, joints } = data;
  const n = times_s.length;
  const end_s = times_s[n - 1]!;
  const listeners = new Set<(lent: JointSample) => void>();
  const lent: Lent = { sequence: 0, time_s: 0, q_rad: new Float64Array(joints), ...data.states[0]! };
  let position_s = 0;
  let speed = 1;
  let stopPlaying: (() => void) | null = null;

  /** Index of the last sample at or before that time. */
  function indexAt(at_s: number): number {
    let low = 0;
    let high = n - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (times_s[middle]! <= at_s) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  function seek(to_s: number): void {
    position_s = Math.min(Math.max(Number.isNaN(to_s) ? 0 : to_s, 0), end_s);
    const index = indexAt(position_s);
    const state = data.states[data.stateOf[index]!]!;
    lent.sequence = data.sequences[index]!;
    lent.time_s = times_s[index]!;
    for (let i = 0; i < joints; i++) lent.q_rad[i] = data.q_rad[index * joints + i]!;
    lent.moving = state.moving;
    lent.mode = state.mode;
    lent.safety = state.safety;
    lent.override = state.override;
    lent.gripperClosed = state.gripperClosed;
    lent.step = state.step;
    lent.message = state.message;
    for (const listen of listeners) listen(lent);
  }

  function pause(): void {
    stopPlaying?.();
    stopPlaying = null;
  }
  function play(): void {
    if (stopPlaying) return;
    if (position_s >= end_s && speed > 0) seek(0);
    let last_s = scheduler.now_s();
    stopPlaying = scheduler.every(FRAME_S, () => {
      const now_s = scheduler.now_s();
      const to_s = position_s + (now_s - last_s) * speed;
      last_s = now_s;
      seek(to_s);
      if ((speed > 0 && to_s >= end_s) || (speed < 0 && to_s <= 0)) pause();
    });
  }

  return {
    name: `Recording of ${robot.name}`,
    robot,
    data,
    events: data.events,
    duration_s: end_s,
    get position_s() {
      return position_s;
    },
    get playing() {
      return stopPlaying !== null;
    },
    onSample(listen) {
      listeners.add(listen);
      return () => {
        listeners.delete(listen);
      };
    },
    close() {
      pause();
      listeners.clear();
    },
    anglesAt(at_s, out, between = "hold") {
      const index = indexAt(at_s);
      const row = index * joints;
      const from_s = times_s[index]!;
      const to_s = index + 1 < n ? times_s[index + 1]! : from_s;
      const span_s = to_s - from_s;
      const part =
        between === "interpolate" && span_s > 0 && span_s <= GAP_S
          ? Math.min(Math.max((at_s - from_s) / span_s, 0), 1)
          : 0;
      for (let i = 0; i < joints; i++) {
        const q = data.q_rad[row + i]!;
        out[i] = part > 0 ? q + part * (data.q_rad[row + joints + i]! - q) : q;
      }
      return out;
    },
    timeline: {
      start_s: 0,
      end_s,
      seek,
      play,
      pause,
      /** 1 is as it was; 0 stands; below 0 runs backwards. */
      setSpeed(factor) {
        if (Number.isFinite(factor)) speed = factor;
      },
    },
  };
}
