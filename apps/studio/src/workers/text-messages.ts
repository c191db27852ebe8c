import type { MoveStep, Pose, Program } from "@twincell/core";
import type { FoundPoints, PatchFile, TextPoint, TouchedUp } from "@twincell/languages";

interface TextTask {
  readonly id: number;
  readonly language: string;
  readonly main: string;
  readonly files: readonly PatchFile[];
  readonly robot: string;
  readonly worldFromBase: Pose<"world", "base">;
}
export type ToTextWorker =
  | (TextTask & { readonly kind: "read"; readonly name: string })
  | (TextTask & {
      readonly kind: "touch-up";
      readonly point: TextPoint;
      readonly move: MoveStep;
      readonly context: Pick<Program, "tools" | "frames">;
      readonly q_rad: readonly number[];
    });

/** A place in a text, by file index and line from 1. */
export interface LinePlace {
  readonly file: number;
  readonly line: number;
}
export interface TextFinding extends LinePlace {
  readonly verdict: "bad" | "warn";
  readonly sentence: string;
}
/** What a text means: its points, what it does step by step, and where each step stands. */
export interface ReadTextProgram {
  readonly points: FoundPoints;
  readonly program: Program | null;
  /** Step id and its place, in the order of execution. */
  readonly places: readonly (readonly [string, LinePlace])[];
  readonly findings: readonly TextFinding[];
  /** Those of them that say what only the controller knows: what the check finds holds without these lines. */
  readonly assumed: readonly TextFinding[];
}
export type FromTextWorker =
  | { readonly kind: "read"; readonly id: number; readonly read: ReadTextProgram }
  | { readonly kind: "touched-up"; readonly id: number; readonly touched: TouchedUp }
  | { readonly kind: "trouble"; readonly id: number; readonly sentence: string };
