import type { Pose } from "../../spatial/pose.ts";
import type { Pallet } from "../pallet.ts";

/** What a step may refer to. */
export interface ProgramScope {
  readonly robot: string;
  readonly joints: number | undefined;
  readonly tools: Readonly<Record<string, Pose<"flange", "tcp">>>;
  readonly frames: Readonly<Record<string, Pose<"world", "frame">>>;
  readonly pallets: Readonly<Record<string, Pallet>>;
  /** Names of all routines, read or not. */
  readonly routines: ReadonlySet<string>;
  /** Ids met so far, with the number of the step. */
  readonly seen: Map<string, number>;
  /** Pallets whose steps these are. */
  readonly open: readonly string[];
  /** Blocks around these steps. */
  readonly depth: number;
}
