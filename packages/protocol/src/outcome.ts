import type { CommandOutcome } from "@twincell/core";

export const DONE: CommandOutcome = { kind: "done" };

/** A refusal of a request: its code, one sentence for a person, and the way out. */
export const refused = (code: string, sentence: string, hint: string): CommandOutcome => ({
  kind: "refused",
  why: { code, sentence, hint },
});
