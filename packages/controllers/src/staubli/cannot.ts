import type { Cannot } from "../driver/index.ts";

/** Over simple_message, with the VAL 3 program ros_server running. */
export const STAUBLI_CANNOT: readonly Cannot[] = [
  {
    row: "T-03",
    because:
      "A point carries a share of the speed and none of the acceleration, and the protocol has no override: half the speed is shown on the way instead.",
  },
  {
    row: "T-10",
    because:
      "The protocol has no word for the arm's power: an emergency stop from here brakes, empties the stack of motions and keeps this client from moving until it is reset, with the power on.",
  },
  {
    row: "texts",
    because:
      "The protocol carries joint points, no programs: VAL 3 texts go to the controller by USB stick or FTP and are started at its pendant.",
  },
  { row: "signals", because: "The protocol of ros_server carries no signals." },
  { row: "payload", because: "The protocol carries no loads: set them at the controller." },
  { row: "watch", because: "The program ros_server serves one client, and stops the robot when that one goes." },
];
