import type { Cannot } from "../driver/index.ts";

/** Over the high-speed Ethernet server. */
export const YASKAWA_CANNOT: readonly Cannot[] = [
  {
    row: "T-03",
    because:
      "Speed is said with each command and the accelerations stay what they are: half the speed is shown on the way instead.",
  },
  { row: "payload", because: "The driver sends no loads: set them at the controller." },
];
