import { createStore } from "zustand/vanilla";

/** The gamepad in use, as the Controls dialog shows it; null when there is none. Written at most ten times a second. */
export interface GamepadState {
  readonly pad: { readonly id: string; readonly buttons: readonly number[]; readonly axes: readonly number[] } | null;
}
export const gamepadStore = createStore<GamepadState>(() => ({ pad: null }));
