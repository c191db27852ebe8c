import type { CollisionBehaviour } from "@twincell/core";
import { createStore } from "zustand/vanilla";

/** What is being searched for in the background: a way round a step, a way to a posture, or the matrix of pairs. */
export type Search =
  | { readonly kind: "way"; readonly step: string; readonly share: number }
  | { readonly kind: "go"; readonly share: number }
  | { readonly kind: "learn" };
export interface CollideState {
  /** What a motion by hand does where it would touch something. A choice of the person, kept with the preferences. */
  readonly behaviour: CollisionBehaviour;
  readonly searching: Search | null;
}
export const collideStore = createStore<CollideState>(() => ({ behaviour: "refuse", searching: null }));
export const chooseBehaviour = (behaviour: CollisionBehaviour): void => collideStore.setState({ behaviour });
