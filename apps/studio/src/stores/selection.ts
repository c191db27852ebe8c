import { createStore } from "zustand/vanilla";

export type Thing =
  | { readonly kind: "robot" }
  | { readonly kind: "link"; readonly link: number }
  | { readonly kind: "tool" }
  | { readonly kind: "object"; readonly id: string }
  | { readonly kind: "frame"; readonly name: string }
  | { readonly kind: "step"; readonly id: string };

export interface SelectionState {
  readonly selected: Thing | null;
  readonly hovered: Thing | null;
}
export const selectionStore = createStore<SelectionState>(() => ({ selected: null, hovered: null }));
export const select = (selected: Thing | null): void => selectionStore.setState({ selected });
export const hover = (hovered: Thing | null): void => selectionStore.setState({ hovered });
