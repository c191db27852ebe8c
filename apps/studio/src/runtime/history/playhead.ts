import { playStore } from "../../stores/play.ts";
import { onSeek } from "../../stores/seek.ts";
import { onFrame } from "../jog/jog-frames.ts";
import { showJoints, theLive } from "../live.ts";
import { leaveRobot, takeRobot } from "../robot/motion-owner.ts";

/** Joint angles at a moment, written to `out`. */
export type SampleAt = (t_s: number, out: Float64Array) => void;
interface Reel {
  readonly duration_s: number;
  readonly sampleAt: SampleAt;
}

/** The exact time lives here; the store hears of it at most ten times a second. */
const TELL_EVERY_MS = 100;
let reel: Reel | null = null;
let t_s = 0;
let told_ms = 0;
let q = new Float64Array(6);

export const playheadNow = (): number => t_s;
/** What `showJoints` counted when the playhead moved the robot last: a higher count is somebody else's. */
let shown = -1;
/** The moment of the program that the robot on screen stands in; null once somebody else has moved it. */
export const shownMoment = (): number | null => (reel !== null && theLive().revision === shown ? t_s : null);

/** What is played from now on; null when there is nothing. The moment is kept where it still exists. */
export function loadReel(next: Reel | null): void {
  reel = next;
  t_s = Math.min(t_s, next?.duration_s ?? 0);
  playStore.setState({ t_s, ...(next ? {} : { playing: false }) });
}
function show(now_ms: number, always: boolean): void {
  if (!reel) return;
  if (q.length !== theLive().q_rad.length) q = new Float64Array(theLive().q_rad.length);
  reel.sampleAt(t_s, q);
  showJoints(q);
  shown = theLive().revision;
  if (always || now_ms - told_ms >= TELL_EVERY_MS) {
    told_ms = now_ms;
    playStore.setState({ t_s });
  }
}

export function seekTo(to_s: number): void {
  if (!reel || !Number.isFinite(to_s)) return;
  takeRobot("play", pause);
  t_s = Math.min(reel.duration_s, Math.max(0, to_s));
  show(0, true);
}
export function play(): void {
  if (!reel || reel.duration_s <= 0) return;
  takeRobot("play", pause);
  if (t_s >= reel.duration_s - 1e-9) t_s = 0;
  playStore.setState({ playing: true });
}
export function pause(): void {
  leaveRobot("play");
  if (playStore.getState().playing) playStore.setState({ playing: false, t_s });
}
export const playOrPause = (): void => (playStore.getState().playing ? pause() : play());

/** Starts listening to the heartbeat and to wishes to look at another moment. */
export function startPlayhead(): () => void {
  const stops = [
    onSeek(seekTo),
    onFrame((now_ms, dt_s) => {
      const { playing, speed } = playStore.getState();
      if (!playing || !reel || speed <= 0) return;
      t_s = Math.min(reel.duration_s, t_s + dt_s * speed);
      const over = t_s >= reel.duration_s;
      show(now_ms, over);
      if (over) pause();
    }),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}
