import type { Refusal, Robot } from "@twincell/core";
import { inDegrees } from "../../refusals.ts";
import { JOINTS } from "../codec/robots.ts";

const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });

export const notReached = (sentence: string): Refusal =>
  refusal(
    "link.refused",
    sentence,
    "Look at the address and the cable, and whether ros_server runs and both of its sockets are set up.",
  );
export const saysNothing = (after_s: number): Refusal =>
  refusal(
    "link.no-answer",
    `The controller sent no joint angles and no status within ${after_s} s.`,
    "Look whether the program ros_server runs at the controller.",
  );
export const closedHere: Refusal = refusal(
  "link.closed",
  "The connection was closed while the robot moved.",
  "Connect again, then command the move again.",
);
export const otherCount = (robot: Robot): Refusal =>
  refusal(
    "link.other-robot",
    `${robot.name} has ${robot.arm.joints.length} joints; the program ros_server moves a Stäubli arm of ${JOINTS}.`,
    "Choose the robot that is there.",
  );
export const otherZero = (robot: Robot): Refusal =>
  refusal(
    "link.joints",
    `${robot.name} counts its joints as V+ does, not as VAL 3: a CS8 or CS9 would move it elsewhere.`,
    "Connect it as a CS7, or describe the robot with VAL 3's zeros.",
  );
export const moreJoints = (robot: Robot, joint: number): Refusal =>
  refusal(
    "link.other-robot",
    `The controller tells of a joint ${joint}; ${robot.name} has ${robot.arm.joints.length}.`,
    "Choose the robot that is there.",
  );
export const beyond = (robot: Robot, joint: number, at_rad: number): Refusal =>
  refusal(
    "link.other-robot",
    `Joint ${joint} of the controller's robot stands at ${inDegrees(at_rad)}, where a ${robot.name} cannot be.`,
    "Choose the robot that is there.",
  );
export const noPath = (what: string): Refusal =>
  refusal(
    "staubli.path",
    `${what} cannot be said over this connection: ros_server moves from joint point to joint point and stops at each.`,
    "Export the program as VAL 3 and start it at the pendant, or use joint moves.",
  );
export const noAcceleration: Refusal = refusal(
  "staubli.acceleration",
  "A softer acceleration cannot be said over this connection: ros_server uses the controller's own.",
  "Leave the acceleration at 100 %, or export the program as VAL 3.",
);
export const notTaken: Refusal = refusal(
  "staubli.refused",
  "The controller did not take the point: it lies outside of the software limits set there, its buffer is full, or a program of its pendant has the arm.",
  "Look at its pendant.",
);
export const wasStopped = (robot: Robot): Refusal =>
  refusal("controller.stopped", `${robot.name} was stopped.`, "Command the move again when the way is clear.");
export const stoodShort = (after_s: number): Refusal =>
  refusal(
    "staubli.short",
    `The robot has stood short of its target for ${after_s} s; the motion was cancelled.`,
    "Look whether Move is pressed at the pendant, then command the move again.",
  );
export const lostPower = (sentence: string): Refusal =>
  refusal(
    "safety.power",
    `${sentence} The motion was cancelled.`,
    "Switch the power on at the pendant, then command the move again.",
  );
export const noPower = (sentence: string): Refusal =>
  refusal(
    "staubli.power",
    `${sentence} It cannot be switched on over this connection.`,
    "Close and acknowledge the emergency-stop chain and press the power button of the pendant.",
  );
export const noSignals: Refusal = refusal(
  "staubli.signals",
  "The protocol of ros_server carries no signals.",
  "Set them in a VAL 3 program.",
);
