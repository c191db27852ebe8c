import {
  FILTER_DEFAULTS,
  type Demonstration,
  type FilteredDemonstration,
  type FilterOptions,
  type InferredPallet,
  type InferRefusal,
  type Vector3,
} from "@twincell/core";
import { createStore } from "zustand/vanilla";

/** A recorded hand that is open: what it showed, and what the filters make of it now. */
export interface OpenDemonstration {
  readonly name: string;
  readonly demonstration: Demonstration;
  /** Lines of its file that were left out. */
  readonly dropped: number;
  readonly options: FilterOptions;
  /** What was asked for last is being worked on. */
  readonly working: boolean;
  /** null until it was filtered for the first time. */
  readonly filtered: FilteredDemonstration | null;
  /** How many places the whole pallet has; undefined: as many as explain best what was shown. */
  readonly places: number | undefined;
  /** What the shown placements stand for; null where nothing was picked and placed. */
  readonly pallet: InferredPallet | InferRefusal | null;
  /** Its places in the world, for drawing. */
  readonly places_m: readonly Vector3[];
}
export const demonstrationStore = createStore<{ readonly open: OpenDemonstration | null }>(() => ({ open: null }));

export const showDemonstration = (name: string, demonstration: Demonstration, dropped: number): void =>
  demonstrationStore.setState({
    open: {
      name,
      demonstration,
      dropped,
      options: FILTER_DEFAULTS,
      working: true,
      filtered: null,
      places: undefined,
      pallet: null,
      places_m: [],
    },
  });
export const hideDemonstration = (): void => demonstrationStore.setState({ open: null });
