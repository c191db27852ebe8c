import type { CarriedPart, CellGeometry, PathPiece, Plan, Program, Verdict } from "@twincell/core";

/** One program to judge. The geometry is sent only when it changed since the last question to this worker. */
export interface ToChecker {
  readonly id: number;
  readonly program: Program;
  readonly robot: string;
  readonly cell?: CellGeometry;
  readonly margin_m: number;
}
export type FromChecker =
  | { readonly kind: "progress"; readonly id: number; readonly share: number }
  | {
      readonly kind: "checked";
      readonly id: number;
      readonly verdict: Verdict;
      readonly plan: Plan;
      readonly path: readonly PathPiece[];
      /** Parts of the cell that the program carries, in the order in which they are taken. */
      readonly carried: readonly CarriedPart[];
      readonly took_ms: number;
    }
  | { readonly kind: "trouble"; readonly id: number; readonly sentence: string };
