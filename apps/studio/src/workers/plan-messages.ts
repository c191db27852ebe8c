import type {
  BaseField,
  CellGeometry,
  Detour,
  Explanation,
  PairMatrix,
  Plan,
  Pose,
  Program,
  RepairedProgram,
  SelfCollisionEscape,
  SuggestedBase,
  Tracking,
} from "@twincell/core";

/** What moves with a frame of the cell, and what a person calls what stands in it. */
export interface FrameParts {
  readonly name: string;
  readonly objects: readonly string[];
  readonly frames: readonly string[];
}
/** A program with bad steps, as it was judged. */
export interface RepairQuestion {
  readonly program: Program;
  readonly robot: string;
  readonly cell: CellGeometry;
  readonly margin_m: number;
  /** By the name of the frame. */
  readonly parts: Readonly<Record<string, FrameParts>>;
  /** Whether the robot itself may be moved. */
  readonly movesBase: boolean;
}

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
  | { readonly kind: "learn"; readonly robot: string; readonly cell: CellGeometry }
  | {
      readonly kind: "accuracy";
      readonly plan: Plan;
      readonly program: Program;
      readonly robot: string;
      readonly worldFromBase: Pose<"world", "base">;
    }
  | ({ readonly kind: "explain"; readonly step: string } & RepairQuestion)
  | ({ readonly kind: "repair-all" } & RepairQuestion)
  | ({ readonly kind: "base-field" } & RepairQuestion);
export interface ToPlanner {
  readonly id: number;
  readonly task: PlanTask;
}

export type FromPlanner =
  | { readonly kind: "progress"; readonly id: number; readonly share: number }
  | { readonly kind: "way"; readonly id: number; readonly answer: Detour }
  | { readonly kind: "go"; readonly id: number; readonly answer: SelfCollisionEscape }
  | { readonly kind: "learnt"; readonly id: number; readonly matrix: PairMatrix }
  | { readonly kind: "accuracy"; readonly id: number; readonly tracking: Tracking }
  | { readonly kind: "explained"; readonly id: number; readonly explanation: Explanation | null }
  | { readonly kind: "field-so-far"; readonly id: number; readonly field: BaseField }
  | {
      readonly kind: "base-field";
      readonly id: number;
      readonly field: BaseField;
      readonly best: SuggestedBase | null;
    }
  | ({ readonly kind: "repaired"; readonly id: number } & Pick<RepairedProgram, "applied" | "left">)
  | { readonly kind: "trouble"; readonly id: number; readonly sentence: string };
