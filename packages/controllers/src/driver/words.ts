import type { Refusal, Robot, Step } from "@twincell/core";

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
export const noSpline = (robot: Robot): Refusal =>
  refusal(
    "controller.motion",
    `${robot.name} cannot be told a spline move by move.`,
    "Run the program as text of the controller's own language.",
  );
export const noSearch = (robot: Robot): Refusal =>
  refusal(
    "controller.motion",
    `${robot.name} cannot be told a search move by move.`,
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
/** One sentence for each reason, with every step that it keeps from being carried out. */
export const unsayable = (reasons: readonly { readonly why: Refusal; readonly steps: readonly string[] }[]): Refusal =>
  refusal(
    reasons[0]!.why.code,
    [
      ...reasons.map(
        ({ why, steps }) =>
          `${steps.map(id => `“${id}”`).join(", ")} cannot be carried out over this connection: ${why.sentence}`,
      ),
      "Nothing has moved.",
    ].join(" "),
    [...new Set(reasons.map(({ why }) => why.hint))].join(" "),
  );
