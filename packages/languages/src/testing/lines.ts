import type { Program, Robot } from "@twincell/core";
import { SIGNALS } from "./programs.ts";

const LOW: Program["signals"] = {
  lamp: { kind: "digital-out", address: 5 },
  "Blow off": { kind: "digital-out", address: 6 },
  part: { kind: "digital-in", address: 3 },
  tray_full: { kind: "digital-in", address: 4 },
};
/** Lines by the names and numbers that each language has; where a language is not named here, `SIGNALS` does. */
const LINES: Readonly<Record<string, Program["signals"]>> = {
  spel: LOW,
  "melfa-basic": LOW,
  pacscript: LOW,
  urscript: {
    lamp: { kind: "digital-out", address: 5 },
    "Blow off": { kind: "digital-out", address: 16 + 1 },
    part: { kind: "digital-in", address: 9 },
    tray_full: { kind: "digital-in", address: 3 },
    level: { kind: "analogue-in", address: 1 },
    valve: { kind: "analogue-out", address: 0 },
  },
  rapid: {
    lamp: { kind: "digital-out" },
    BlowOff: { kind: "digital-out" },
    part: { kind: "digital-in" },
    tray_full: { kind: "digital-in" },
    level: { kind: "analogue-in" },
    valve: { kind: "analogue-out" },
  },
  val3: {
    lamp: { kind: "digital-out" },
    blowOff: { kind: "digital-out" },
    part: { kind: "digital-in" },
    trayFull: { kind: "digital-in" },
    level: { kind: "analogue-in" },
    valve: { kind: "analogue-out" },
  },
  "kawasaki-as": {
    lamp: { kind: "digital-out", address: 5 },
    "Blow off": { kind: "digital-out", address: 6 },
    part: { kind: "digital-in", address: 1003 },
    tray_full: { kind: "digital-in", address: 1004 },
  },
};

/** Lines that random programs in that dialect may use. */
export const linesOf = (dialect: string): Program["signals"] => LINES[dialect] ?? SIGNALS;

/**
 * Whether the language can ask for a posture of that robot by its name: nobody has published the names of this one's.
 */
export const namesConfigurations = (dialect: string, robot: Robot): boolean =>
  !(dialect === "rapid" && robot.id === "abb_crb15000_5_95");
