import type { Vector3 } from "@twincell/core";
import { createStore } from "zustand/vanilla";

export type Sound = "crash" | "limit" | "grip" | "link-lost" | "done";
/** Which sound was asked for last and how many there were: whoever plays sounds listens, and so do tests. */
export interface SoundState {
  readonly last: Sound | null;
  readonly count: number;
  /** Where it comes from as seen by the ears: right, up, behind [m]; null: from nowhere. */
  readonly from: Readonly<Vector3> | null;
  readonly played: Readonly<Record<Sound, number>>;
}
export const soundStore = createStore<SoundState>(() => ({
  last: null,
  count: 0,
  from: null,
  played: { crash: 0, limit: 0, grip: 0, "link-lost": 0, done: 0 },
}));
let place: ((name: Sound) => Vector3 | null) | null = null;
/** Who knows where a sound comes from says so; null: nobody does. */
export function soundsComeFrom(ask: ((name: Sound) => Vector3 | null) | null): void {
  place = ask;
}
export const sound = (name: Sound): void =>
  soundStore.setState(({ count, played }) => ({
    last: name,
    count: count + 1,
    from: place?.(name) ?? null,
    played: { ...played, [name]: played[name] + 1 },
  }));
