import type { MoveStep, Refusal, Robot, Step } from "@twincell/core";

const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });

export const notOpen = (name: string): Refusal =>
  refusal("link.closed", `${name} is not connected.`, "Connect it, then command the move again.");
export const linkDown = (name: string, because: string): Refusal =>
  refusal(
    "link.lost",
    `${name} is not connected: ${because}`,
    "It is tried again by itself; command the move again when the link is back.",
  );
export const cameLate = (name: string, silent_s: number): Refusal =>
  refusal(
    "link.stale",
    `Nothing came from ${name} for ${Math.round(silent_s * 1000)} ms.`,
    "It is tried again by itself; command the move again when the link is back.",
  );
export const noAnswer = (name: string, after_s: number): Refusal =>
  refusal(
    "link.no-answer",
    `${name} did not answer within ${after_s} s.`,
    "Look at its address, its cable and whether it is on.",
  );
export const noSuchMotion = (robot: Robot, step: MoveStep, what: string): Refusal =>
  refusal(
    "controller.motion",
    `Step “${step.id}” is ${what}, which ${robot.name} cannot be told move by move.`,
    "Run the program as text of the controller's own language.",
  );
export const noPayload = (robot: Robot): Refusal =>
  refusal(
    "controller.payload",
    `${robot.name} cannot be told its payload over this connection.`,
    "Set it at the controller, or run the program as text.",
  );
export const notPrimitive = (step: Step): Refusal =>
  refusal(
    "controller.step",
    `Step “${step.id}” holds other steps; a controller takes them one by one.`,
    "Unroll the program first.",
  );
export const waitedInVain = (step: string, signal: string, seconds: number): Refusal =>
  refusal(
    "signals.timeout",
    `Step “${step}” waited ${seconds} s for the signal “${signal}”.`,
    "Look why the signal did not come, or give it more time.",
  );
export const resetUnseen = (robot: Robot, after_s: number): Refusal =>
  refusal(
    "controller.reset-unseen",
    `${robot.name} took the reset and still says, ${after_s} s later, that it is stopped.`,
    "Look at the robot what keeps it stopped, then reset again.",
  );
export const wasStopped = (robot: Robot): Refusal =>
  refusal("controller.stopped", `${robot.name} was stopped.`, "Command the move again when the way is clear.");
