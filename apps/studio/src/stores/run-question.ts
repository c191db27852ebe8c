import { createStore } from "zustand/vanilla";

/** A run that was asked for and has not begun: the check is under way, or it is not content. */
export interface RunQuestion {
  /**
   * "checking": waits for the check. "red": it found something. "unchecked": it could not be done, and `sentence` says
   * why.
   */
  readonly kind: "checking" | "red" | "unchecked";
  readonly sentence: string;
  /** Begins it all the same, in spite of the findings of these codes: a connected robot takes it for no others. */
  readonly proceed: (despite: readonly string[]) => void;
}
export const runQuestionStore = createStore<{ readonly question: RunQuestion | null }>(() => ({ question: null }));
