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
  | "own-robot"
  | "dh-table"
  | "station"
  | "collision"
  | "cameras"
  | "people"
  | "together"
  | "fleet"
  | "shapes"
  | "run-question"
  | "demonstration"
  | "glove"
  | "registration"
  | "device";
export interface DialogState {
  readonly open: DialogName | null;
  /** The controller that is asked for is a real one, on the network. */
  readonly real?: boolean;
}
export const dialogStore = createStore<DialogState>(() => ({ open: null }));
export const openDialog = (open: DialogName): void => dialogStore.setState({ open, real: false });
export const openRealController = (): void => dialogStore.setState({ open: "station", real: true });
export const closeDialog = (): void => dialogStore.setState({ open: null });
