import type { Cannot } from "../driver/index.ts";

/** Over variables, with the program TWINCELL running. */
export const KUKA_CANNOT: readonly Cannot[] = [
  {
    row: "T-17",
    because:
      "A command takes two questions, a cycle and a poll to come through (about 10 ms), three times of which is more than one frame; how the greatest speed scales a motion is measured at the robot instead.",
  },
  { row: "payload", because: "The driver sends no loads: set them at the controller." },
];

/** Over the Robot Sensor Interface. */
export const KUKA_RSI_CANNOT: readonly Cannot[] = [
  {
    row: "T-17",
    because:
      "The driver makes the path itself, at the speeds of the robot it was handed: what a virtual controller is slowed down to is not asked for.",
  },
  { row: "payload", because: "The driver sends no loads: set them at the controller." },
  { row: "watch", because: "RSI is a loop of the one who corrects the robot; to look at it alone use the variables." },
];
