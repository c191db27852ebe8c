import { createStore } from "zustand/vanilla";

/** Whether a program may run although its check is not green; asked by a dialog. */
export interface RunQuestion {
  /** Who would run it, by name. */
  readonly robots: readonly string[];
  /** At least one of them is a real robot: running anyway must be typed. */
  readonly real: boolean;
  /** Models that run it and were not the one it was checked for. */
  readonly otherModels: readonly string[];
  /** A text that is not the cell's: what the check says is of another program. */
  readonly otherText?: boolean;
}
export interface RunQuestionState {
  readonly question: RunQuestion | null;
}
export const runQuestionStore = createStore<RunQuestionState>(() => ({ question: null }));

let waiting: ((run: boolean) => void) | null = null;

/** Resolves with what the person answers. A second question answers the one before with no. */
export function askToRun(question: RunQuestion): Promise<boolean> {
  waiting?.(false);
  return new Promise(resolve => {
    waiting = resolve;
    runQuestionStore.setState({ question });
  });
}
export function answerToRun(run: boolean): void {
  const tell = waiting;
  waiting = null;
  runQuestionStore.setState({ question: null });
  tell?.(run);
}
