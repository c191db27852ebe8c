import type { Refusal, Robot } from "@twincell/core";
import { UNLOCK_AFTER_S } from "../codec/modes.ts";

const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });

export const jointCount = (robot: Robot, joints: number): Refusal =>
  refusal(
    "link.other-robot",
    `${robot.name} has ${robot.arm.joints.length} joints; robots of Universal Robots have ${joints}.`,
    "Choose the robot that is there.",
  );
export const otherModel = (robot: Robot, wanted: string, is: string): Refusal =>
  refusal(
    "link.other-robot",
    `${robot.name} was expected, which its controller calls ${wanted}; a ${is} answers.`,
    "Choose the robot that is there, or the address of the other one.",
  );
export const noAnswer = (sentence: string): Refusal =>
  refusal("link.refused", sentence, "Look at its address, its cable, and whether it is on.");
export const inLocal = (robot: Robot): Refusal =>
  refusal(
    "controller.local",
    `${robot.name} is in local control: its teach pendant has it.`,
    "Switch it to remote control at the pendant.",
  );
export const notReady = (robot: Robot, mode: string, safety: string): Refusal =>
  refusal(
    "controller.not-ready",
    `${robot.name} is not ready to move: robot mode ${mode}, safety mode ${safety}.`,
    "Reset it: that powers it on and releases its brakes.",
  );
export const otherProgram = (robot: Robot): Refusal =>
  refusal(
    "controller.program-running",
    `A program that was not started here is running on ${robot.name}.`,
    "Stop it first.",
  );
export const noStart = (robot: Robot, why: string): Refusal =>
  refusal(
    "controller.program",
    `The control program did not start on ${robot.name}${why === "" ? "." : `: ${why}`}`,
    "Look at the log of its controller.",
  );
export const ended = (robot: Robot, why: string): Refusal =>
  refusal(
    "controller.stopped",
    `The motion of ${robot.name} ended before its target${why === "" ? "." : `: ${why}`}`,
    "Clear the cause, then command the move again.",
  );
export const programFailed = (sentence: string): Refusal =>
  refusal("controller.program-fault", sentence, "Look at that line of the program.");
export const tooSoon = (robot: Robot): Refusal =>
  refusal(
    "safety.too-soon",
    `A protective stop of ${robot.name} can be unlocked ${UNLOCK_AFTER_S} s after it happened, not sooner.`,
    "Look at its cause, then reset again.",
  );
export const buttonPressed = (robot: Robot): Refusal =>
  refusal(
    "safety.emergency-stop",
    `The emergency stop of ${robot.name} is pressed.`,
    "Turn the button out at the robot, then reset.",
  );
export const stillGuarded = (robot: Robot): Refusal =>
  refusal("safety.guard-stop", `The safeguard of ${robot.name} is open.`, "Close it, then reset.");
export const dashboardSays = (command: string, answer: string | null): Refusal =>
  refusal(
    "controller.dashboard",
    answer === null
      ? `The dashboard did not answer “${command}”.`
      : `The dashboard answered “${command}” with: ${answer}`,
    "Look at the robot's pendant.",
  );
export const tookTooLong = (robot: Robot, what: string, seconds: number): Refusal =>
  refusal("controller.slow", `${robot.name} was not ${what} within ${seconds} s.`, "Look at the robot's pendant.");
export const noSuchLine = (signal: string): Refusal =>
  refusal(
    "signals.unknown",
    `The control box has no output “${signal}”.`,
    "Its outputs are digital_out_0 to digital_out_17 and analog_out_0 to analog_out_1.",
  );
export const noText = (): Refusal =>
  refusal("controller.no-text", "There is no program text to run.", "Export the program in URScript first.");
