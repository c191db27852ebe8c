import { createStore } from "zustand/vanilla";

export type StudioMode = "cell" | "teach" | "check" | "run" | "history";
export type SheetTab = "jog" | "program" | "why" | "run";
export interface ViewState {
  readonly mode: StudioMode;
  readonly theme: "dark" | "light";
  readonly camera: "main" | "close";
  /** 0 … π/2, row N-44. */
  readonly closeTilt_rad: number;
  /** −1 … 1: how fast a stick turns the view to the right and up (row X-31). */
  readonly turning: readonly [number, number];
  /** "level": at TCP height (N-45); "offset": 0.5, 0.5, 0.1 m from the TCP (N-42). */
  readonly closePlacement: "level" | "offset";
  readonly muted: boolean;
  readonly inHeadset: boolean;
  /** Which tab of the bottom sheet a phone shows. */
  readonly sheet: SheetTab;
  /** The drawer with plots under the timeline. */
  readonly plots: boolean;
  /** The coach was dismissed for ever. */
  readonly coachDone: boolean;
  /** Counts up with every wish to enter the headset; the scene answers, since it owns the session. */
  readonly headsetWish: number;
}
export const viewStore = createStore<ViewState>(() => ({
  mode: "teach",
  theme: "dark",
  camera: "main",
  closeTilt_rad: 0,
  turning: [0, 0],
  closePlacement: "level",
  muted: false,
  inHeadset: false,
  sheet: "jog",
  plots: false,
  coachDone: false,
  headsetWish: 0,
}));

export const showMode = (mode: StudioMode): void => viewStore.setState({ mode });
export const toggleTheme = (): void =>
  viewStore.setState(({ theme }) => ({ theme: theme === "dark" ? "light" : "dark" }));
export const toggleMuted = (): void => viewStore.setState(({ muted }) => ({ muted: !muted }));
/** Row N-36. */
export const toggleCamera = (): void =>
  viewStore.setState(({ camera }) => ({ camera: camera === "main" ? "close" : "main" }));
/** Rows N-42, N-45: at the height of the TCP, or 0.5, 0.5, 0.1 m from it. */
export const toggleClosePlacement = (): void =>
  viewStore.setState(({ closePlacement }) => ({ closePlacement: closePlacement === "level" ? "offset" : "level" }));
/** Row N-44: an analogue trigger 0 … 1 tilts the close camera 0 … 90°. */
export const tiltCloseCamera = (trigger: number): void =>
  viewStore.setState({ closeTilt_rad: (Math.min(1, Math.max(0, trigger)) * Math.PI) / 2 });
/** Row X-31: a stick turns the view about what is looked at, as fast as it is deflected. */
export function turnView([right, up]: readonly [number, number]): void {
  const [x, y] = viewStore.getState().turning;
  if (x !== right || y !== up) viewStore.setState({ turning: [right, up] });
}
export const wishHeadset = (): void => viewStore.setState(({ headsetWish }) => ({ headsetWish: headsetWish + 1 }));
