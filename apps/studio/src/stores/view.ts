import { createStore } from "zustand/vanilla";

export type StudioMode = "teach" | "check" | "run" | "history";
export interface ViewState {
  readonly mode: StudioMode;
  readonly theme: "dark" | "light";
  readonly camera: "main" | "close";
  /** 0 … π/2, row N-44. */
  readonly closeTilt_rad: number;
  /** "level": at TCP height (N-45); "offset": 0.5, 0.5, 0.1 m from the TCP (N-42). */
  readonly closePlacement: "level" | "offset";
  readonly muted: boolean;
  readonly inHeadset: boolean;
}
export const viewStore = createStore<ViewState>(() => ({
  mode: "teach", theme: "dark", camera: "main", closeTilt_rad: 0, closePlacement: "offset", muted: false, inHeadset: false,
}));
