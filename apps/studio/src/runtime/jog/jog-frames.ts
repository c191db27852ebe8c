import { addEffort } from "../effort.ts";

/**
 * One heartbeat for everything that moves on screen. The window drives it; inside a headset, where the window
 * stands still, the scene does. Two drivers at once do no harm: a call less than 1 ms after the last is skipped.
 */
export type OnFrame = (now_ms: number, dt_s: number) => void;
const readers = new Set<OnFrame>();
let last_ms = 0;

/** After a pause (hidden tab) nothing jumps: one frame never counts for more than this. */
const LONGEST_FRAME_S = 0.1;

export function tick(now_ms: number): void {
  const elapsed_ms = now_ms - last_ms;
  if (elapsed_ms < 1 && elapsed_ms >= 0) return;
  last_ms = now_ms;
  const dt_s = Math.min(LONGEST_FRAME_S, Math.max(0, elapsed_ms / 1000));
  const began_ms = performance.now();
  for (const read of readers) read(now_ms, dt_s);
  addEffort(performance.now() - began_ms);
}
export function onFrame(read: OnFrame): () => void {
  readers.add(read);
  return () => readers.delete(read);
}
