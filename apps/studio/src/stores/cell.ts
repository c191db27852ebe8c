import type { CellDocument } from "@twincell/project";
import { createStore } from "zustand/vanilla";

export type Saving =
  | { readonly kind: "saved" }
  | { readonly kind: "saving" }
  | { readonly kind: "unsaved" }
  | { readonly kind: "problem"; readonly sentence: string };

/** The document being worked on. Changed only through `commit`, `undo` and `redo` (in `stores/document.ts`). */
export interface CellState {
  readonly document: CellDocument | null;
  readonly saving: Saving;
  /** Labels of what undo and redo would do, newest first. */
  readonly undo: readonly string[];
  readonly redo: readonly string[];
  /** Counts up when a vendor's text has been executed: what it does is known from then on. */
  readonly executions: number;
}
export const cellStore = createStore<CellState>(() => ({
  document: null,
  saving: { kind: "saved" },
  undo: [],
  redo: [],
  executions: 0,
}));
