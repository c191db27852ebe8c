import type { Cannot } from "../driver/index.ts";

/** A UR takes all of it. */
export const UR_CANNOT: readonly Cannot[] = [];
