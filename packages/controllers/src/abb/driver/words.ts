import type { Refusal, Robot } from "@twincell/core";
import { EGM_STATE, MOTORS, type EgmRobot } from "../codec/index.ts";

const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });

export const nobody = (port: number, host: string): Refusal => refusal("link.no-answer", `No controller at ${host} sends EGM messages to port ${port} of this machine.`, "Look at the transmission protocol that is set up on the controller (UCdevice: address of this machine, port), and start the RAPID program that waits for targets.");
export const otherAxes = (robot: Robot, axes: number): Refusal => refusal("link.other-robot", `${robot.name} has ${robot.arm.joints.length} axes; the robot whose controller sends has ${axes}.`, "Choose the robot that is there.");
export const taken = (sentence: string): Refusal => refusal("link.no-port", sentence, "Another program listens there: end it, or set up another port on the controller.");
export const noLines = (): Refusal => refusal("abb.no-signals", "EGM carries targets, no signals.", "Let the RAPID program on the controller set them.");
export const noDrives = (robot: Robot): Refusal => refusal("abb.no-drives", `The motors of ${robot.name} are not switched by EGM.`, "Switch the motors on at the cabinet and start the RAPID program that waits for targets.");
export const wasStopped = (robot: Robot): Refusal => refusal("controller.stopped", `${robot.name} was stopped.`, "Command the move again when the way is clear.");
export const linkClosed = (robot: Robot): Refusal => refusal("link.closed", `The line to ${robot.name} was closed: without targets it stops by itself.`, "Connect it, then command the move again.");
export const notGuided = (robot: Robot, because: string): Refusal => refusal("abb.not-guided", `${robot.name} does not take targets. ${because}`, "Start the RAPID program that waits for targets.");

/** Why a robot does not follow; "" while it does. */
export function notGuidedBecause({ motors, state, rapid }: EgmRobot): string {
  if (motors === MOTORS.off) return "Its motors are off.";
  if (state === EGM_STATE.error) return "EGM ended with an error on the controller.";
  if (state !== EGM_STATE.running) return "EGM is stopped on the controller.";
  return rapid === 1 ? "The RAPID program is stopped." : "";
}
