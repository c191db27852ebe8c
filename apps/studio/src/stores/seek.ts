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
