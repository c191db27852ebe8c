import type { CellDefinition, PreparedJob } from "@twincell/controllers";
import type { Pose, Program, Robot } from "@twincell/core";

/** Robots and languages go by their ids: both sides have the library. */
export interface PrepareJobRequest {
  readonly id: number;
  readonly robot: string;
  /** The robot itself, where it came from a file. */
  readonly own: Robot | null;
  readonly dialect: string | null;
  readonly program: Program;
  readonly start_rad: Float64Array;
  readonly cell: CellDefinition | null;
  readonly worldFromBase: Pose<"world", "base"> | null;
}
export type PrepareJobAnswer =
  | { readonly id: number; readonly laid: PreparedJob }
  | { readonly id: number; readonly trouble: string };
