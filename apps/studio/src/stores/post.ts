import type { Emitted } from "@twincell/core";
import type { Proof } from "@twincell/languages";
import { createStore } from "zustand/vanilla";

/** The program as text of the robot's language, and the proof that the text does the same. */
export interface PostState {
  readonly working: boolean;
  readonly emitted: Emitted | null;
  /** One for each runnable file. */
  readonly proof: Proof | null;
  readonly trouble: string | null;
}
export const postStore = createStore<PostState>(() => ({ working: false, emitted: null, proof: null, trouble: null }));
