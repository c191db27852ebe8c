/** Why a command was not carried out, or carried out only in part. */
export interface Refusal {
  readonly code: string;
  readonly sentence: string;
  readonly hint: string;
  /** Where a joint or a limit is the reason: which (counts from 1), what was wanted, what is allowed [SI]. */
  readonly joint?: number;
  readonly value?: number;
  readonly limit?: number;
}
export type CommandOutcome =
  | { readonly kind: "done" }
  | { readonly kind: "refused"; readonly why: Refusal }
  | { readonly kind: "stopped"; readonly why: Refusal };

/** A place in a text, counted from 1. */
export interface TextPlace {
  readonly line: number;
  readonly column: number;
}
export interface TextFault extends TextPlace {
  readonly expected: string;
  readonly sentence: string;
}
