import type { JointSample, Robot, Scheduler, StateSource, Timeline } from "@twincell/core";
import type { History, Moment } from "./history.ts";

/** A history looked at: the same door as a live robot, with a timeline. Times count from its first sample. */
export interface HistoryPlayer extends StateSource {
  readonly timeline: Timeline;
  readonly history: History;
  readonly position_s: number;
  readonly playing: boolean;
  /** What stands on the timeline now, once its part of the file is read. */
  readonly moment: Moment | null;
  /** Called when a part of the file cannot be read. */
  onTrouble(listen: (sentence: string) => void): () => void;
}

const FRAME_S = 1 / 60;
/** While playing, what comes so much later is read ahead, at the pace it is played. */
const AHEAD_S = 1;
type Lent = { -readonly [K in keyof JointSample]: JointSample[K] };

/** Moments that are at hand are shown at once; for the others the file is read, and the last wish wins. */
export function playHistory(history: History, robot: Robot, scheduler: Scheduler): HistoryPlayer {
  const listeners = new Set<(lent: JointSample) => void>();
  const worried = new Set<(sentence: string) => void>();
  let position_s = 0;
  let speed = 1;
  let stopPlaying: (() => void) | null = null;
  let moment: Moment | null = null;
  let wish = 0;
  let closed = false;

  function show(now: Moment): void {
    moment = now;
    const { state } = now;
    const lent: Lent = {
      sequence: now.sequence,
      time_s: now.t_s,
      q_rad: now.q_rad,
      ...state,
      signals: new Map(Object.entries(now.signals)),
    };
    for (const listen of listeners) listen(lent);
  }
  const tell = (reason: unknown): void => {
    for (const listen of worried)
      listen(
        `This part of the recording cannot be read: ${reason instanceof Error ? reason.message : String(reason)}.`,
      );
  };
  function seek(to_s: number): void {
    position_s = Math.min(Math.max(Number.isNaN(to_s) ? 0 : to_s, 0), history.duration_s);
    const mine = ++wish;
    const here = history.peek(position_s);
    if (here) {
      show(here);
      return;
    }
    history.at(position_s).then(
      there => {
        if (mine === wish && !closed) show(there);
      },
      (reason: unknown) => {
        if (mine === wish && !closed) {
          pause();
          tell(reason);
        }
      },
    );
  }
  function readAhead(): void {
    const ahead_s = position_s + speed * AHEAD_S;
    // A part that cannot be read is told when it is reached.
    if (ahead_s >= 0 && ahead_s <= history.duration_s && !history.peek(ahead_s))
      history.at(ahead_s).catch(() => undefined);
  }
  function pause(): void {
    stopPlaying?.();
    stopPlaying = null;
  }
  function play(): void {
    if (stopPlaying) return;
    if (position_s >= history.duration_s && speed > 0) seek(0);
    let last_s = scheduler.now_s();
    stopPlaying = scheduler.every(FRAME_S, () => {
      const now_s = scheduler.now_s();
      const to_s = position_s + (now_s - last_s) * speed;
      last_s = now_s;
      if ((speed > 0 && to_s >= history.duration_s) || (speed < 0 && to_s <= 0)) pause();
      seek(to_s);
      readAhead();
    });
  }

  return {
    name: `Recording of ${robot.name}`,
    robot,
    history,
    get position_s() {
      return position_s;
    },
    get playing() {
      return stopPlaying !== null;
    },
    get moment() {
      return moment;
    },
    onSample(listen) {
      listeners.add(listen);
      return () => {
        listeners.delete(listen);
      };
    },
    onTrouble(listen) {
      worried.add(listen);
      return () => {
        worried.delete(listen);
      };
    },
    close() {
      closed = true;
      pause();
      listeners.clear();
      worried.clear();
    },
    timeline: {
      start_s: 0,
      end_s: history.duration_s,
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
