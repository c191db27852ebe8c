import type { Branch } from "./branch.ts";

/** Joint angles that reach a pose, with the branch they belong to; undefined for arms whose postures have no names. */
export interface Solution {
  readonly q_rad: Float64Array;
  readonly branch: Branch | undefined;
}

/**
 * Whether and how a pose can be reached. "Why can it not?" is a `switch` over `kind`;
 * a new cause does not compile until every view says something about it.
 */
export type Reach =
  /**
   * All distinct solutions inside the limits, ±2π copies included, least total travel first when `near` was given.
   * `considered` counts the candidates they were taken from: closed-form branches times a turn less, none, or more of
   * each joint. `method` is "numeric" for an arm without a closed form: solutions that a search found from `considered`
   * starts, maybe not all, and without their copies by whole turns.
   */
  | {
      readonly kind: "reached";
      readonly method?: "numeric";
      readonly solutions: readonly Solution[];
      readonly singular: boolean;
      readonly considered: number;
    }
  | { readonly kind: "too-far"; readonly beyond_m: number; readonly reach_m: number }
  | { readonly kind: "too-near"; readonly inside_m: number; readonly nearest_m: number }
  /** The links would reach it, but the maker declares a smaller workspace, counted from axis 2 to the wrist centre. */
  | { readonly kind: "beyond-workspace"; readonly distance_m: number; readonly declared_m: number }
  /** The wrist can be brought there, but not so turned: at best it is this far from the wanted orientation. */
  | { readonly kind: "not-so-turned"; readonly short_rad: number }
  /** The branch that comes closest to the limits; joint counts from 1. */
  | {
      readonly kind: "outside-limits";
      readonly joint: number;
      readonly wanted_rad: number;
      readonly limit_rad: number;
      readonly slides?: boolean;
      readonly branch: Branch | undefined;
    }
  | { readonly kind: "no-solver"; readonly because: string }
  | { readonly kind: "not-a-pose"; readonly because: string };
