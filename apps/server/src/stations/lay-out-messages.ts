import type { CellDefinition, LaidOut } from "@twincell/controllers";
import type { Pose, Program } from "@twincell/core";

/** Robots and languages go by their ids: both sides have the library. */
export interface ToLayOut {
  readonly id: number;
  readonly robot: string;
  readonly dialect: string | null;
  readonly program: Program;
  readonly start_rad: Float64Array;
  readonly cell: CellDefinition | null;
  readonly worldFromBase: Pose<"world", "base"> | null;
}
export type FromLayOut =
  | { readonly id: number; readonly laid: LaidOut }
  | { readonly id: number; readonly trouble: string };
