import type { Cannot } from "../driver/index.ts";

/** Over the Remote Motion Interface. */
export const FANUC_CANNOT: readonly Cannot[] = [
  {
    row: "T-17",
    because:
      "A command and its answer take about 10 ms to come through, three times of which is more than one frame; how the greatest speed scales a motion is measured at the robot instead.",
  },
  { row: "payload", because: "The driver sends no loads: set them at the controller." },
];
