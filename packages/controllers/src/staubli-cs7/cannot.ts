import type { Cannot } from "../driver/index.ts";

/** Over the monitor of V+, with the program TWC.MOVE in memory. */
export const CS7_CANNOT: readonly Cannot[] = [
  {
    row: "texts",
    because:
      "The monitor takes no programs over its line, as far as is known here: a V+ text goes to the controller's disk and is loaded there.",
  },
  { row: "payload", because: "V+ learns the load from the controller's configuration." },
];
