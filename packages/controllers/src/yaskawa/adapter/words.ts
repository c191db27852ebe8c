import type { Refusal, Robot } from "@twincell/core";
import { addressText, type Address } from "../../transport/index.ts";
import { refusalSentence, type Status } from "../codec/index.ts";
import type { Answer } from "./client.ts";

const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });

export const noArc = (robot: Robot): Refusal =>
  refusal(
    "yaskawa.arc",
    `${robot.name} cannot be told an arc by a command of its Ethernet server.`,
    "Run the program as a job: INFORM has MOVC.",
  );
export const noPulses = (robot: Robot, count: number): Refusal =>
  refusal(
    "yaskawa.pulses",
    `The pulses per degree of ${count} axes are given for ${robot.name}, which has ${robot.arm.joints.length}.`,
    "Take them from the parameter file (ALL.PRM) of the controller.",
  );
export const otherModel = (robot: Robot, wanted: string, is: string): Refusal =>
  refusal(
    "link.other-robot",
    `${robot.name} was expected, known to its controller as "${wanted}"; the controller says it moves "${is}".`,
    "Choose the robot that is there, or set the model text that its controller answers.",
  );
export const otherAxes = (robot: Robot, model: string, axes: number): Refusal =>
  refusal(
    "link.other-robot",
    `${robot.name} has ${robot.arm.joints.length} axes; the ${model} that answers has ${axes}.`,
    "Choose the robot that is there.",
  );
export const noWay = (to: Address, answer: Answer): Refusal =>
  answer.kind === "silent"
    ? refusal(
        "link.no-answer",
        `Nothing answers at ${addressText(to)} (UDP).`,
        "Look at the address, the cable, whether the controller is on and its Ethernet server is allowed.",
      )
    : refusal(
        "link.refused",
        `The controller at ${addressText(to)} refused: ${refusalSentence(answer.reply.status, answer.reply.added)}`,
        "Look at the settings of its Ethernet server.",
      );
export const badAnswer = (to: Address): Refusal =>
  refusal(
    "link.bad-answer",
    `What ${addressText(to)} answers is too short to be understood.`,
    "Look whether a Yaskawa controller is at this address.",
  );
export const notTaken = (what: string, answer: Answer): Refusal =>
  answer.kind === "silent"
    ? refusal(
        "yaskawa.silent",
        `${what}: the controller did not answer for ${answer.after_s.toFixed(1)} s.`,
        "Look at the link; the robot may still do what it was told.",
      )
    : refusal(
        "yaskawa.refused",
        `${what}: ${refusalSentence(answer.reply.status, answer.reply.added)}`,
        hintFor(answer.reply.added),
      );
export const noLine = (signal: string): Refusal =>
  refusal(
    "signals.unknown",
    `The signal "${signal}" has no address on this controller.`,
    "Give it the number of a network input, such as 27010.",
  );
export const notWritable = (signal: string, logical: number): Refusal =>
  refusal(
    "signals.not-writable",
    `The signal "${signal}" is line ${logical}; only network inputs (27010 to 29567) are written from outside.`,
    "Give it the number of a network input, and let the ladder of the controller pass it on.",
  );
export const noLadder = (signal: string, logical: number): Refusal =>
  refusal(
    "signals.not-writable",
    `The signal "${signal}" is output ${logical}; outputs are switched by the ladder of the controller, and which network input it passes on to them is not said.`,
    "Name a network input (27010 to 29567) instead, or say which one stands for OT#(1).",
  );
export const notDigital = (signal: string): Refusal =>
  refusal(
    "signals.kind",
    `The signal "${signal}" is on or off; a level cannot be said to it.`,
    "Use a register or a variable for levels.",
  );
export const noGripper = (robot: Robot): Refusal =>
  refusal(
    "controller.gripper",
    `No line is set for the gripper of ${robot.name}.`,
    "Give the gripper the number of a network input, such as 27010.",
  );
export const endedEarly = (robot: Robot): Refusal =>
  refusal(
    "yaskawa.ended",
    `${robot.name} came to rest before its target.`,
    "Look at the pendant, then command the move again.",
  );
export const linkClosed = (robot: Robot): Refusal =>
  refusal(
    "link.closed",
    `The line to ${robot.name} was closed; a hold was sent as the last word.`,
    "Connect it, then command the move again.",
  );
export const wasStopped = (robot: Robot): Refusal =>
  refusal("controller.stopped", `${robot.name} was stopped.`, "Command the move again when the way is clear.");
export const neverOn = (robot: Robot, seconds: number): Refusal =>
  refusal(
    "yaskawa.servo",
    `The servo power of ${robot.name} did not come on within ${seconds} s.`,
    "Look at the pendant: an emergency stop or a gate may keep it off.",
  );
export const noJob = (): Refusal =>
  refusal("yaskawa.no-job", "There is no job (.JBI) among the files.", "Export the program as INFORM.");
export const badName = (name: string): Refusal =>
  refusal(
    "yaskawa.job-name",
    `"${name}" is no name for a file of this controller.`,
    "Use up to 32 letters, digits and signs of the Latin alphabet, and .JBI behind them.",
  );
export const jobPace = (robot: Robot): Refusal =>
  refusal(
    "yaskawa.override",
    `The speed of a job of ${robot.name} is set at its pendant.`,
    "Set it there; a speed of 0 holds the job, 100 lets it go on.",
  );

const hintFor = (added: number): string =>
  added === 0x2100 || added === 0x2080
    ? "Turn the key switch to REMOTE and set command remote at the pendant."
    : added === 0x2070
      ? "Turn the servo power on: reset the robot."
      : added === 0x2060
        ? "Clear the alarm: reset the robot."
        : added >= 0x2020 && added <= 0x2050
          ? "Release the hold where it was set."
          : "Look at the pendant of the controller.";

/** Why a robot stands that should not; undefined when nothing says so. */
export function standsBecause(status: Status): string | undefined {
  if (status.error && !status.servo) return "The emergency stop is pressed, or an error is present.";
  if (status.alarm) return "An alarm is present.";
  if (status.error) return "An error is present.";
  if (status.heldOutside) return "An external signal holds the robot.";
  if (status.heldByPendant) return "The teach pendant holds the robot.";
  if (status.heldByCommand) return "A command holds the robot.";
  if (!status.servo) return "The servo power is off.";
  if (status.teach) return "The key switch was turned to TEACH.";
  return status.remote ? undefined : "The controller is not in remote mode any more.";
}
export const stands = (robot: Robot, because: string): Refusal =>
  refusal(
    "yaskawa.stands",
    `${robot.name} stopped. ${because}`,
    "Clear the cause, reset the robot, then command the move again.",
  );
export const noSoftness = (robot: Robot): Refusal =>
  refusal(
    "yaskawa.acceleration",
    `${robot.name} cannot be told an acceleration by a command of its Ethernet server.`,
    "Run the program as a job: INFORM has ACC= and DEC=.",
  );
export const unknownPulses = (robot: Robot): Refusal =>
  refusal(
    "yaskawa.pulses-unknown",
    `The pulses per degree of this ${robot.name} are not known.`,
    "Take them from the parameter file (ALL.PRM) of its controller.",
  );
