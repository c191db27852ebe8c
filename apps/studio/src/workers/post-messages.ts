import type { Pose, Program } from "@twincell/core";
import type { Proof } from "@twincell/languages";
import type { Written } from "../runtime/run/written-program.ts";

/** `dialect` null: no language speaks for the robot. With `prove` the text is read back after it was answered. */
export interface ToPoster {
  readonly id: number;
  readonly dialect: string | null;
  /** Another form of its text; null for its programs. */
  readonly form: string | null;
  readonly program: Program;
  readonly robot: string;
  readonly worldFromBase: Pose<"world", "base">;
  readonly prove: boolean;
}
export type FromPoster =
  | { readonly kind: "written"; readonly id: number; readonly written: Written }
  | { readonly kind: "proven"; readonly id: number; readonly proof: Proof | null }
  | { readonly kind: "trouble"; readonly id: number; readonly sentence: string };
