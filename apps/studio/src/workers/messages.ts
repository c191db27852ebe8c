import type { WatchedCell } from "@twincell/core";

/**
 * What the page tells the collision worker. Only the newest posture counts: the page sends one and waits for its
 * answer.
 */
export type ToWatcher =
  | { readonly kind: "cell"; readonly cell: WatchedCell; readonly edition: number }
  | { readonly kind: "look"; readonly q_rad: Float64Array };

export type FromWatcher =
  | {
      readonly kind: "sight";
      readonly edition: number;
      readonly contacts: readonly (readonly [string, string])[];
      readonly touched: readonly string[];
      readonly clearance_m: number;
      readonly nearest: readonly [string, string];
      readonly took_ms: number;
    }
  | { readonly kind: "trouble"; readonly sentence: string };
