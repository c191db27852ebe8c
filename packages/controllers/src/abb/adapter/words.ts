import type { Refusal, Robot } from "@twincell/core";
import { EGM_FILE, EGM_STATE, MOTORS, type EgmRobot } from "../codec/index.ts";

const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });

export const nobody = (port: number, host: string): Refusal =>
  refusal(
    "link.no-answer",
    `No controller at ${host} sends EGM messages to port ${port} of this machine.`,
    "Look at the transmission protocol that is set up on the controller (UCdevice: address of this machine, port), and start the RAPID program that waits for targets.",
  );
export const noServices = (host: string, port: number, sentence: string): Refusal =>
  refusal(
    "link.refused",
    `No Robot Web Services at ${host}:${port}: ${sentence}`,
    "Look at the address and the cable. A controller with RobotWare 7 (OmniCore) serves other ones, over TLS, which are not spoken here.",
  );
export const otherAxes = (robot: Robot, axes: number): Refusal =>
  refusal(
    "link.other-robot",
    `${robot.name} has ${robot.arm.joints.length} axes; the robot whose controller sends has ${axes}.`,
    "Choose the robot that is there.",
  );
export const otherRobot = (robot: Robot, said: string): Refusal =>
  refusal(
    "link.other-robot",
    `${robot.name} was expected; the controller moves the robot "${said}".`,
    "Choose the robot that is there.",
  );
export const taken = (sentence: string): Refusal =>
  refusal("link.no-port", sentence, "Another program listens there: end it, or set up another port on the controller.");
export const noLines = (): Refusal =>
  refusal("abb.no-signals", "EGM carries targets, no signals.", "Let the RAPID program on the controller set them.");
export const noSuchLine = (signal: string): Refusal =>
  refusal(
    "abb.no-such-signal",
    `The controller has no signal "${signal}".`,
    "Name it as the controller's configuration does (EIO).",
  );
export const noDrives = (robot: Robot): Refusal =>
  refusal(
    "abb.no-drives",
    `The motors of ${robot.name} are not switched by EGM.`,
    "Switch the motors on at the cabinet and start the RAPID program that waits for targets.",
  );
export const wasStopped = (robot: Robot): Refusal =>
  refusal("controller.stopped", `${robot.name} was stopped.`, "Command the move again when the way is clear.");
export const linkClosed = (robot: Robot): Refusal =>
  refusal(
    "link.closed",
    `The line to ${robot.name} was closed: without targets it stops by itself.`,
    "Connect it, then command the move again.",
  );
export const servicesLost = (robot: Robot, sentence: string): Refusal =>
  refusal(
    "link.lost",
    `Robot Web Services of ${robot.name} are gone: ${sentence} The robot was stopped.`,
    "They are tried again by themselves; motion is not.",
  );
export const guidingLost = (robot: Robot, silent_s: number): Refusal =>
  refusal(
    "link.lost",
    `No EGM message came from ${robot.name} for ${Math.round(1000 * silent_s)} ms. Its program was stopped.`,
    "Look at the cable and at the program that waits for targets; motion is not tried again.",
  );
export const notStreamed = (robot: Robot, because: string): Refusal =>
  refusal(
    "abb.not-guided",
    `${robot.name} does not take targets. ${because}`,
    `Reset it, which starts its RAPID program; for motions from here that is one that waits for targets (${EGM_FILE}).`,
  );
export const refusedThere = (
  what: string,
  sentence: string,
  hint = "Look at the event log of the controller.",
): Refusal => refusal("abb.refused", `${what}: ${sentence}`, hint);
export const manualThere = (robot: Robot): Refusal =>
  refusal(
    "controller.manual-mode",
    `${robot.name} is in manual mode: its motors and programs are its pendant's.`,
    "Turn the key at the controller to automatic.",
  );
export const noGuiding = (robot: Robot): Refusal =>
  refusal(
    "abb.not-guided",
    `The motors of ${robot.name} are on, but no program there waits for targets.`,
    `Load ${EGM_FILE} on the controller; the page of ABB's controllers in the documentation says how.`,
  );
export const noModule = (): Refusal =>
  refusal("abb.no-module", "There is no RAPID module among the files.", "Hand over a .mod with PROC main.");

/** Why a robot does not follow; "" while it does. */
export function notStreamedBecause({ motors, state, rapid }: EgmRobot): string {
  if (motors === MOTORS.off) return "Its motors are off.";
  if (state === EGM_STATE.error) return "EGM ended with an error on the controller.";
  if (state !== EGM_STATE.running) return "EGM is stopped on the controller.";
  return rapid === 1 ? "The RAPID program is stopped." : "";
}
