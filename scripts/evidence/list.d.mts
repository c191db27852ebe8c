export interface Evidence {
  readonly name: string;
  /** The file with the dated result, from the repository's root. */
  readonly result: string;
  /** What Node runs to make it anew. */
  readonly command: readonly string[];
  /** Folders whose code it judges. */
  readonly judges: readonly string[];
}
export const EVIDENCE: readonly Evidence[];
export function scriptsOf(evidence: readonly Evidence[], root: string): readonly string[];
