import { createStore } from "zustand/vanilla";

export type Sound = "crash" | "limit" | "grip" | "link-lost" | "done";
/** Which sound was asked for last and how many there were: whoever plays sounds listens, and so do tests. */
export interface SoundState {
  readonly last: Sound | null;
  readonly count: number;
  readonly played: Readonly<Record<Sound, number>>;
}
export const soundStore = createStore<SoundState>(() => ({
  last: null,
  count: 0,
  played: { crash: 0, limit: 0, grip: 0, "link-lost": 0, done: 0 },
}));
export const sound = (name: Sound): void =>
  soundStore.setState(({ count, played }) => ({
    last: name,
    count: count + 1,
    played: { ...played, [name]: played[name] + 1 },
  }));
