import type { Branch, Robot } from "@twincell/core";

/**
 * Robots whose CS8 or CS9 controller speaks VAL 3, and how it names their postures. Joint angles are those of the
 * library in degrees: all zero stands straight up. The RX90L stands on a CS7 and speaks V+.
 */
const SPEAKS: ReadonlySet<string> = new Set(["staubli_rx160"]);
export const speaksVal3 = (robot: Robot): boolean => SPEAKS.has(robot.id);

/** Righty has the wrist in front of axis 1; elbow and wrist go by the signs of joints 3 and 5. */
export const configWords = (branch: Branch | undefined): readonly [shoulder: string, elbow: string, wrist: string] =>
  branch === undefined
    ? ["ssame", "esame", "wsame"]
    : [
        branch.shoulder === "front" ? "righty" : "lefty",
        (branch.elbow === "up") === (branch.shoulder === "front") ? "epositive" : "enegative",
        branch.wrist === "positive" ? "wpositive" : "wnegative",
      ];

/** The tool whose valve is the gripper. */
export const GRIPPER = "gripper";
export const VALVE = "valve1";
