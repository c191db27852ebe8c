import type { OperatingMode, SafetyState } from "@twincell/core";
import type { Status } from "../codec/simple-message.ts";

const MANUAL = 1;
const AUTOMATIC = 2;

/** Local and remote look the same from here; while nothing is known of the mode nobody is to move the robot. */
export const modeOf = ({ mode }: Status): OperatingMode => (mode === AUTOMATIC ? "remote" : "manual");
export const isByHand = ({ mode }: Status): boolean => mode === MANUAL;

export function safetyOf({ emergency, powered, inError, possible }: Status, locked: boolean): SafetyState {
  if (emergency || locked) return "emergency-stop";
  return powered && possible && !inError ? "normal" : "protective-stop";
}
/** What keeps the robot from moving, in words; "" when nothing does. */
export function sentenceOf({ emergency, powered, error, inError, possible }: Status): string {
  if (emergency) return "The emergency-stop chain of the robot is open.";
  if (inError) return `A task of ros_server stands with the error ${error}.`;
  if (!powered) return "The power of the arm is off.";
  return possible ? "" : "The emergency-stop chain is not acknowledged, or a task of ros_server stands.";
}
