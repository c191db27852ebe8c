import { createStore } from "zustand/vanilla";

/** A run that was asked for and has not begun: the check is under way, or it is not content. */
export interface RunQuestion {
  /**
   * "checking": waits for the check. "red": it found something. "unchecked": it could not be done, and `sentence` says
   * why. "assumed": lines of a vendor's text do what only the controller knows, and the check judged the rest.
   */
  readonly kind: "checking" | "red" | "unchecked" | "assumed";
  readonly sentence: string;
  /** Connected robots that it would move. */
  readonly ids: readonly string[];
  /** Names of the robots that would move and are no virtual ones: for them the answer is typed. */
  readonly real: readonly string[];
  /** Begins it all the same, in spite of the findings of these codes: a connected robot takes it for no others. */
  readonly proceed: (despite: readonly string[]) => void;
}
export const runQuestionStore = createStore<{ readonly question: RunQuestion | null }>(() => ({ question: null }));
