import { createStore } from "zustand/vanilla";

/** Where a picture comes from: a camera of this computer, or one that shows itself through the server. */
export type VideoSource =
  | { readonly kind: "here"; readonly device: string }
  | { readonly kind: "server"; readonly name: string };
export interface VideoPanel {
  readonly id: string;
  readonly name: string;
  readonly source: VideoSource;
  /** Why there is no picture or no new one, in words, or "". */
  readonly trouble: string;
}
export interface VideoState {
  readonly panels: readonly VideoPanel[];
  /** Cameras that show themselves through the server now. */
  readonly cameras: readonly { readonly camera: number; readonly name: string }[];
  /** Cameras of this computer; without a permission the browser does not name them. */
  readonly devices: readonly { readonly device: string; readonly name: string }[];
  /** By which other machines open the page of a camera. */
  readonly links: readonly string[];
  readonly server: "off" | "connecting" | "open" | "gone";
  readonly sentence: string;
  /** The panel by whose pictures the twin is held back, or null. */
  readonly heldBy: string | null;
  /** The panel whose latency is being measured, or null. */
  readonly measured: string | null;
}
export const videoStore = createStore<VideoState>(() => ({
  panels: [],
  cameras: [],
  devices: [],
  links: [],
  server: "off",
  sentence: "",
  heldBy: null,
  measured: null,
}));

export const panelOf = (id: string): VideoPanel | undefined =>
  videoStore.getState().panels.find(panel => panel.id === id);
export function changePanel(id: string, change: Partial<VideoPanel>): void {
  videoStore.setState(({ panels }) => ({
    panels: panels.map(panel => (panel.id === id ? { ...panel, ...change } : panel)),
  }));
}
