import type { Step } from "@twincell/core";
import { playStore } from "./play.ts";

/** Somebody wants to look at another moment; `live/playhead.ts` answers. */
const seekers = new Set<(t_s: number) => void>();
export function onSeek(listen: (t_s: number) => void): () => void {
  seekers.add(listen);
  return () => seekers.delete(listen);
}
export function seek(t_s: number): void {
  for (const listen of seekers) listen(t_s);
}
/** To the end of that step, where its target is. False when the plan does not have it. */
export function seekStep(id: string): boolean {
  const segment = playStore.getState().plan?.segments.findLast(each => each.step === id);
  if (!segment) return false;
  seek(segment.start_s + segment.duration_s);
  return true;
}

/** Somebody wants to see a step as it would be, before it is so; null goes back. */
const previewers = new Set<(step: Step | null) => void>();
export function onPreview(listen: (step: Step | null) => void): () => void {
  previewers.add(listen);
  return () => previewers.delete(listen);
}
export function previewStep(step: Step | null): void {
  for (const listen of previewers) listen(step);
}
