import { words } from "../../messages/index.ts";

const SAID = words.headset;

/** Why a headset was not entered, and the way on. */
export interface NotEntered {
  readonly sentence: string;
  readonly hint?: string;
}

/** What the browser threw when it was asked for a session, as a person can use it. */
export function whyNotEntered(problem: unknown): NotEntered {
  const name = problem instanceof Error || problem instanceof DOMException ? problem.name : "";
  if (name === "NotAllowedError" || name === "SecurityError")
    return { sentence: SAID.notAllowed, hint: SAID.notAllowedHint };
  if (name === "NotSupportedError") return { sentence: SAID.notSupported, hint: SAID.notSupportedHint };
  if (name === "InvalidStateError") return { sentence: SAID.headsetBusy, hint: SAID.headsetBusyHint };
  return { sentence: SAID.notStarted(problem instanceof Error ? problem.message : String(problem)) };
}

/** How a session ended: by the key, by the headset itself, or by the headset while the tool was held. */
export type Ending = "left" | "ended" | "ended-held";

/** What is said of it; who left by the key knows. */
export function whatEnded(ending: Ending): string | null {
  if (ending === "left") return null;
  return ending === "ended-held" ? SAID.endedHeld : SAID.ended;
}
