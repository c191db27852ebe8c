import { FILTER_DEFAULTS, type Demonstration, type FilteredDemonstration, type FilterOptions } from "@twincell/core";
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
}
export const demonstrationStore = createStore<{ readonly open: OpenDemonstration | null }>(() => ({ open: null }));

export const showDemonstration = (name: string, demonstration: Demonstration, dropped: number): void =>
  demonstrationStore.setState({
    open: { name, demonstration, dropped, options: FILTER_DEFAULTS, working: true, filtered: null },
  });
export const hideDemonstration = (): void => demonstrationStore.setState({ open: null });
