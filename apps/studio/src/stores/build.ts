import { createStore } from "zustand/vanilla";

export type BuildTool = "select" | "move" | "turn" | "scale" | "measure" | "mate" | "rig";

/** How things are moved in Cell mode. */
export interface BuildState {
  readonly tool: BuildTool;
  /** Handles along the axes of the world, or along those of what is selected. */
  readonly space: "world" | "local";
  readonly snap: boolean;
  /** Distance between the lines of the grid [m]; 0 for none. */
  readonly grid_m: number;
  /** How surfaces are drawn (row M-10). */
  readonly display: "smooth" | "flat" | "wire" | "points";
  /** Height above which the cell is cut away [m]; null for no section. */
  readonly section_m: number | null;
  /** The part of the library that is being dragged into the cell. */
  readonly carrying: string | null;
  /** A handle is being dragged. */
  readonly dragging: boolean;
}
export const buildStore = createStore<BuildState>(() => ({
  tool: "move",
  space: "world",
  snap: true,
  grid_m: 0.01,
  display: "smooth",
  section_m: null,
  carrying: null,
  dragging: false,
}));
export const chooseTool = (tool: BuildTool): void => buildStore.setState({ tool });
