import { createStore } from "zustand/vanilla";

export type Thing =
  | { readonly kind: "robot" }
  | { readonly kind: "link"; readonly link: number }
  | { readonly kind: "tool" }
  | { readonly kind: "object"; readonly id: string }
  | { readonly kind: "frame"; readonly name: string }
  | { readonly kind: "routine"; readonly name: string }
  | { readonly kind: "step"; readonly id: string };

export interface SelectionState {
  readonly selected: Thing | null;
  /** Ids of objects that are selected besides it. */
  readonly more: readonly string[];
  readonly hovered: Thing | null;
}
export const selectionStore = createStore<SelectionState>(() => ({ selected: null, more: [], hovered: null }));
export const select = (selected: Thing | null): void => selectionStore.setState({ selected, more: [] });
/** These objects, the first of them as the one whose numbers are shown. */
export const selectObjects = ([first, ...more]: readonly string[]): void =>
  selectionStore.setState({ selected: first === undefined ? null : { kind: "object", id: first }, more });
/** Ids of all objects that are selected, the one whose numbers are shown first. */
export const selectedObjects = ({ selected, more }: SelectionState = selectionStore.getState()): readonly string[] =>
  selected?.kind === "object" ? [selected.id, ...more] : [];
/** Ctrl or Shift and a click: the object joins what is selected, or leaves it. */
export function alsoSelect(id: string): void {
  const all = selectedObjects();
  selectObjects(all.includes(id) ? all.filter(each => each !== id) : [...all, id]);
}
export const hover = (hovered: Thing | null): void => selectionStore.setState({ hovered });
