import { createStore } from "zustand/vanilla";

/** How large the cell is drawn on its marker: 1 is 1:1. */
export const MARKER_SCALES = [1, 0.5, 0.2, 0.1] as const;
export type MarkerScale = (typeof MARKER_SCALES)[number];

/** The view through this device's camera with the cell on a printed marker (rows L-04, L-59). */
export interface MarkerViewState {
  readonly on: boolean;
  /** Why there is no picture; "" while there is one, or while the browser is being asked. */
  readonly problem: string;
  /** Name of the camera; "" before it was allowed. */
  readonly camera: string;
  readonly seen: boolean;
  readonly distance_m: number;
  /** How far the corners are from where the pose puts them [px]. */
  readonly error_px: number;
  /** From the picture's arrival to its pose [s]. */
  readonly took_s: number;
  readonly lens: "assumed" | "calibrated";
  readonly scale: MarkerScale;
  /** The objects of the cell are drawn too; otherwise what stands there is what the camera sees (row L-61). */
  readonly objects: boolean;
  /** The side of the marker's black square as it was printed [m]. */
  readonly side_m: number;
  /** Views of the board taken so far; null when no lens is being calibrated. */
  readonly views: number | null;
  /** What the last calibration said. */
  readonly calibration: string;
  /** The tool follows this device. */
  readonly carrying: boolean;
}
export const markerViewStore = createStore<MarkerViewState>(() => ({
  on: false,
  problem: "",
  camera: "",
  seen: false,
  distance_m: 0,
  error_px: 0,
  took_s: 0,
  lens: "assumed",
  scale: 1,
  objects: false,
  side_m: 0.1,
  views: null,
  calibration: "",
  carrying: false,
}));
export const openMarkerView = (): void => markerViewStore.setState({ on: true, problem: "" });
export const closeMarkerView = (): void =>
  markerViewStore.setState({ on: false, seen: false, carrying: false, views: null });
