import { createStore } from "zustand/vanilla";

/**
 * Whether a headset can be entered, and if not, why: for the button and its tip. `null` while the browser is being
 * asked.
 */
export interface HeadsetState {
  readonly ready: boolean | null;
  readonly reason: string;
}
export const headsetStore = createStore<HeadsetState>(() => ({ ready: null, reason: "" }));

/** The scene owns the session and says here how it is left. */
let leaving: (() => void) | null = null;
export const leaveHeadset = (): void => leaving?.();
export function leaveHeadsetBy(leave: (() => void) | null): void {
  leaving = leave;
}
