import { createStore } from "zustand/vanilla";

/** At most one dialog is open. */
export type DialogName =
  | "cells"
  | "palette"
  | "shortcuts"
  | "controls"
  | "export"
  | "import"
  | "robots"
  | "station"
  | "collision"
  | "cameras"
  | "shapes"
  | "run-question";
export interface DialogState {
  readonly open: DialogName | null;
}
export const dialogStore = createStore<DialogState>(() => ({ open: null }));
export const openDialog = (open: DialogName): void => dialogStore.setState({ open });
export const closeDialog = (): void => dialogStore.setState({ open: null });
