import type { Evidence } from "./list.mjs";

export interface EvidenceState {
  readonly name: string;
  readonly level: "missing" | "older" | "current";
  readonly made: string | undefined;
  readonly changed: string | undefined;
  readonly judges: readonly string[];
}
export function evidenceStates(evidence: readonly Evidence[], root: string): readonly EvidenceState[];
export function dateOf(text: string): string | undefined;
export function stateSentence(state: EvidenceState): string;
