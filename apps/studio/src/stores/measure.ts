import { clearanceBetween, measured, type Clearance, type Measured, type MeasuredPoint } from "@twincell/project";
import { createStore } from "zustand/vanilla";
import { cellStore } from "./cell.ts";

/** What was picked to be measured, and what came of it. */
export interface MeasureState {
  readonly picks: readonly MeasuredPoint[];
  readonly result: Measured | null;
  /** Of the two objects that were picked, when they are two. */
  readonly clearance: Clearance | null;
}
const NOTHING: MeasureState = { picks: [], result: null, clearance: null };
export const measureStore = createStore<MeasureState>(() => NOTHING);
export const clearMeasure = (): void => measureStore.setState(NOTHING);

/** The first pick begins, the second measures, a third begins anew. */
export function pickToMeasure(point: MeasuredPoint): void {
  const { picks } = measureStore.getState();
  const [first] = picks;
  if (first === undefined || picks.length > 1) {
    measureStore.setState({ picks: [point], result: null, clearance: null });
    return;
  }
  const objects = cellStore.getState().document?.objects ?? [];
  const a = objects.find(({ id }) => id === first.object);
  const b = objects.find(({ id }) => id === point.object);
  measureStore.setState({
    picks: [first, point],
    result: measured(first, point),
    clearance: a && b && a !== b ? clearanceBetween(a, b) : null,
  });
}
