import type { CommandOutcome, Refusal } from "@twincell/core";

/** How commands end, for who answers them. */
export const DONE: CommandOutcome = { kind: "done" };
export const refused = (why: Refusal): CommandOutcome => ({ kind: "refused", why });
export const stopped = (why: Refusal): CommandOutcome => ({ kind: "stopped", why });
