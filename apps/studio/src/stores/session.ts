import type { SessionInfo } from "@twincell/protocol";
import { createStore } from "zustand/vanilla";

/** Who is at this page, as its server says. */
export interface SessionState {
  /** "none": nobody signs in here, or there is no server. */
  readonly state: "unknown" | "none" | "signed-out" | "signed-in";
  readonly info: SessionInfo | null;
  /** What a link carried that lets somebody choose a password; null without one. */
  readonly invitation: string | null;
}
export const sessionStore = createStore<SessionState>(() => ({ state: "unknown", info: null, invitation: null }));
