import type { Demonstration, FilteredDemonstration, FilterOptions, ReadDemonstration } from "@twincell/core";

/** `text` is read first and kept for the questions after it; without one the demonstration read last is filtered. */
export interface ToDemonstrator {
  readonly id: number;
  readonly text: string | null;
  readonly options: FilterOptions;
}
export type FromDemonstrator =
  | { readonly kind: "read"; readonly id: number; readonly demonstration: Demonstration; readonly dropped: number }
  | {
      readonly kind: "unreadable";
      readonly id: number;
      readonly why: Extract<ReadDemonstration, { kind: "unreadable" }>;
    }
  | { readonly kind: "filtered"; readonly id: number; readonly filtered: FilteredDemonstration }
  | { readonly kind: "trouble"; readonly id: number; readonly sentence: string };
