import type { CellGeometry, PairMatrix, Program, SelfCollisionEscape, Detour } from "@twincell/core";

/** Searches that take a while. Cancelling ends the worker. */
export type PlanTask =
  | {
      readonly kind: "way";
      readonly program: Program;
      readonly step: string;
      readonly robot: string;
      readonly cell: CellGeometry;
      readonly margin_m: number;
    }
  | {
      readonly kind: "go";
      readonly robot: string;
      readonly cell: CellGeometry;
      readonly from_rad: readonly number[];
      readonly to_rad: readonly number[];
    }
  | { readonly kind: "learn"; readonly robot: string; readonly cell: CellGeometry };
export interface ToPlanner {
  readonly id: number;
  readonly task: PlanTask;
}

export type FromPlanner =
  | { readonly kind: "progress"; readonly id: number; readonly share: number }
  | { readonly kind: "way"; readonly id: number; readonly answer: Detour }
  | { readonly kind: "go"; readonly id: number; readonly answer: SelfCollisionEscape }
  | { readonly kind: "learnt"; readonly id: number; readonly matrix: PairMatrix }
  | { readonly kind: "trouble"; readonly id: number; readonly sentence: string };
