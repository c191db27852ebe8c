import type { Emitted, Pose, Program } from "@twincell/core";
import type { Proof } from "@twincell/languages";

export interface ToPoster { readonly id: number; readonly dialect: string; readonly program: Program; readonly robot: string; readonly worldFromBase: Pose<"world", "base"> }
export type FromPoster =
  | { readonly kind: "posted"; readonly id: number; readonly emitted: Emitted; readonly proof: Proof | null }
  | { readonly kind: "trouble"; readonly id: number; readonly sentence: string };
