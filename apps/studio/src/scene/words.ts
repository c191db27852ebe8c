import { words } from "../messages/index.ts";

/** What the scene says. */
export const WORDS = words.scene;
