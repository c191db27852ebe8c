import type { Cannot } from "../driver/index.ts";

/** Over EGM and Robot Web Services 1.0. */
export const ABB_CANNOT: readonly Cannot[] = [
  { row: "payload", because: "The driver sends no loads: a program says its own (GripLoad)." },
];

/** Over externally guided motion alone. */
export const ABB_EGM_CANNOT: readonly Cannot[] = [
  {
    row: "T-10",
    because:
      "EGM has no word for the motors: an emergency stop brakes hard and then falls silent, which ends EGM on the controller; a person starts it there again.",
  },
  { row: "texts", because: "EGM carries targets, no programs." },
  { row: "signals", because: "EGM carries targets, no signals." },
  { row: "payload", because: "EGM carries targets, no loads." },
  { row: "watch", because: "EGM tells its state to the one who guides it, and to nobody else." },
];
