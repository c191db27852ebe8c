import type { Refusal, Robot } from "@twincell/core";
import { inDegrees } from "../../refusals.ts";
import { PROGRAM, STATE } from "../codec/monitor.ts";

const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });

export const notReached = (sentence: string): Refusal =>
  refusal(
    "link.refused",
    sentence,
    "Look at the address of the serial adapter, the cable, and whether another terminal has the line.",
  );
export const saysNothing = (after_s: number): Refusal =>
  refusal(
    "link.no-answer",
    `No prompt of V+ came within ${after_s} s.`,
    "Look whether the controller is on and the adapter is set to 9600 baud, 8 bits, no parity.",
  );
export const closedHere: Refusal = refusal(
  "link.closed",
  "The connection was closed while the robot moved.",
  "Connect again, then command the move again.",
);
export const otherCount = (robot: Robot, count: number): Refusal =>
  refusal(
    "link.other-robot",
    `The controller moves a robot of ${count} joints; ${robot.name} has ${robot.arm.joints.length}.`,
    "Choose the robot that is there.",
  );
export const unknownJoints = (robot: Robot): Refusal =>
  refusal(
    "link.joints",
    `How V+ counts the joints of ${robot.name} is not known.`,
    "Choose a robot that stands on a CS7.",
  );
export const beyond = (robot: Robot, joint: number, at_rad: number): Refusal =>
  refusal(
    "link.other-robot",
    `Joint ${joint} of the controller's robot stands at ${inDegrees(at_rad)}, where a ${robot.name} cannot be.`,
    "Choose the robot that is there.",
  );
export const noArc: Refusal = refusal("cs7.arc", "Standard V+ has no arcs.", "Use lines through points of the arc.");
export const saidNo = (error: string): Refusal =>
  /undefined program/i.test(error)
    ? refusal(
        "cs7.program",
        `The program ${PROGRAM} is not in the memory of the controller (${error}).`,
        "LOAD TWINCELL.V2 at the controller, then command the move again.",
      )
    : refusal("cs7.refused", `The controller refused: ${error}`, "Look at its terminal, then command the move again.");
export const stoodShort = (error: string): Refusal =>
  refusal(
    "cs7.short",
    error === "" ? "The motion ended short of its target." : `The motion ended short of its target: ${error}`,
    "Look at the terminal of the controller, then command the move again.",
  );
export const taken = (sentence: string): Refusal =>
  refusal(
    "safety.power",
    `${sentence} The motion was ended.`,
    "Put it right at the robot, then command the move again.",
  );
export const wasStopped = (robot: Robot): Refusal =>
  refusal("controller.stopped", `${robot.name} was stopped.`, "Command the move again when the way is clear.");
export const noReset = (sentence: string): Refusal =>
  refusal("cs7.reset", sentence, "Put it right at the robot first.");
export const noLine = (signal: string): Refusal =>
  refusal("cs7.line", `“${signal}” is no digital output of the controller.`, "Name it out_1 and so on.");

/** What keeps the robot from moving, in words; "" when nothing does. */
export function stateWords(state: number): string {
  switch (state) {
    case STATE.program:
      return "";
    case STATE.manual:
      return "The pendant has the robot (manual control).";
    case STATE.notCalibrated:
      return "The robot is not calibrated: CALIBRATE at the controller's terminal, with everybody out of its way.";
    case STATE.calibrating:
      return "The robot is being calibrated.";
    case STATE.fatal:
      return "A fatal error keeps high power off.";
    default:
      return "High power is off.";
  }
}
