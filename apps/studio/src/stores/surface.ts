import type { SurfaceFeature } from "@twincell/core";
import { createStore } from "zustand/vanilla";
import { buildStore } from "./build.ts";
import { viewStore } from "./view.ts";

/** A bore, shaft, round edge or face of an object, in the world. */
export interface PickedSurface {
  readonly object: string;
  readonly feature: SurfaceFeature;
}

/** What a click would take while axes and faces are picked. */
export const surfaceStore = createStore<{ readonly hovered: PickedSurface | null }>(() => ({ hovered: null }));

/** Whether clicks in the 3D view pick axes and faces now. */
export function picksSurfaces(): boolean {
  const { tool } = buildStore.getState();
  return viewStore.getState().mode === "cell" && (tool === "mate" || tool === "rig");
}

export function hoverSurface(surface: PickedSurface | null): void {
  const { hovered } = surfaceStore.getState();
  if (JSON.stringify(hovered) !== JSON.stringify(surface)) surfaceStore.setState({ hovered: surface });
}
