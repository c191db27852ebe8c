import type { Branch } from "@twincell/core";

/** Righty has the wrist in front of axis 1; elbow and wrist go by the signs of joints 3 and 5. */
export const configWords = (
  branch: Branch | undefined,
  above: Branch["wrist"],
): readonly [shoulder: string, elbow: string, wrist: string] =>
  branch === undefined
    ? ["ssame", "esame", "wsame"]
    : [
        branch.shoulder === "front" ? "righty" : "lefty",
        (branch.elbow === "up") === (branch.shoulder === "front") ? "epositive" : "enegative",
        branch.wrist === above ? "wpositive" : "wnegative",
      ];

/** The tool whose valve is the gripper. */
export const GRIPPER = "gripper";
export const VALVE = "valve1";
