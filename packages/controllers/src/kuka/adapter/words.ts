import type { Refusal, Robot } from "@twincell/core";
import { AXES } from "../codec/axes.ts";
import { LOOP_NAME, LOOP_VERSION } from "../codec/loop.ts";

const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });

export const noProxy = (sentence: string): Refusal =>
  refusal(
    "link.refused",
    sentence,
    "Look at the address, the cable, and whether the C3 Bridge runs on the controller.",
  );
export const otherRobot = (robot: Robot, said: string): Refusal =>
  refusal(
    "link.other-robot",
    `${robot.name} was expected; the controller says it moves a ${said}.`,
    "Choose the robot that is there, or give the name that its controller uses.",
  );
export const otherJoints = (robot: Robot): Refusal =>
  refusal(
    "link.other-robot",
    `${robot.name} has ${robot.arm.joints.length} joints; the controller of a KUKA counts ${AXES} axes.`,
    "Choose the robot that is there.",
  );
export const unknownAxes = (robot: Robot): Refusal =>
  refusal(
    "link.axes",
    `How a KUKA controller counts the axes of ${robot.name} is not known.`,
    "Give the signs and zeros of its axes.",
  );
export const oldProxy = refusal(
  "link.protocol",
  "The proxy on the controller does not read several variables at once.",
  "Put the C3 Bridge, version 1.2 or later, in the place of KUKAVARPROXY.",
);
export const unreadable = refusal(
  "link.protocol",
  "The controller does not tell its axes and its mode.",
  "Look whether the proxy reaches the controller's variables.",
);
export const noLoop = refusal(
  "kuka.no-loop",
  `The program ${LOOP_NAME} is not on the controller; without it the robot can be watched, not moved.`,
  `Copy ${LOOP_NAME}.src and ${LOOP_NAME}.dat to the controller.`,
);
export const otherLoop = (version: string): Refusal =>
  refusal(
    "kuka.no-loop",
    `The program ${LOOP_NAME} on the controller is version ${version}; this is version ${LOOP_VERSION}.`,
    "Copy the newer files to the controller.",
  );
export const loopRests = (state: string, name: string): Refusal =>
  refusal(
    "kuka.loop-rests",
    name === LOOP_NAME
      ? `The program ${LOOP_NAME} does not run (${state}).`
      : `The program ${LOOP_NAME} is not selected${name === "" ? "" : `; ${name} is`}.`,
    "Reset the robot here, or select and start it at the pendant.",
  );
export const drivesOff = refusal(
  "kuka.drives-off",
  "The drives are off.",
  "Switch them on at the robot, or from its remote control.",
);
export const notTaken = refusal(
  "kuka.not-taken",
  "The controller did not take the motion.",
  "Look at the messages on its pendant.",
);
export const notCarriedOut = refusal(
  "kuka.stopped",
  "The robot stopped before the motion ended.",
  "Look at the messages on its pendant; reset the robot, then command the move again.",
);
export const refusedThere = refusal(
  "kuka.refused",
  `The program ${LOOP_NAME} refused the motion.`,
  "Reset the robot, then command the move again.",
);
export const linkSilent = refusal(
  "link.watchdog",
  "The robot braked by itself: nothing was heard from here for too long.",
  "Command the move again when the line is steady.",
);
export const stoppedHere = (robot: Robot): Refusal =>
  refusal("controller.stopped", `${robot.name} was stopped.`, "Command the move again when the way is clear.");
export const closedHere = refusal(
  "link.closed",
  "The connection was closed while the robot moved; the robot brakes by itself.",
  "Connect again, then command the move again.",
);
export const notAtPendant = refusal(
  "kuka.pendant",
  "The program cannot be started from here in T1 or T2.",
  "Turn the key to AUT or EXT, or start it at the pendant.",
);
export const startRefused = (state: string): Refusal =>
  refusal(
    "kuka.start",
    `The controller did not start the program ${LOOP_NAME} (${state}).`,
    "Look at the messages on its pendant, and whether the drives are on.",
  );
export const noProgramControl = refusal(
  "kuka.no-control",
  "The proxy on the controller cannot select and start programs.",
  "Start the program at the pendant, or use the C3 Bridge.",
);
export const noFiles = refusal(
  "kuka.no-files",
  "The proxy on the controller cannot take files.",
  "Use the C3 Bridge, version 1.1 or later, or copy the files to the controller by hand.",
);
export const fileRefused = (name: string): Refusal =>
  refusal(
    "kuka.file",
    `The controller did not take the file ${name}.`,
    "Look at its name and at the memory of the controller.",
  );
export const programRefused = (name: string): Refusal =>
  refusal(
    "kuka.program",
    `The controller did not select and start ${name}.`,
    "Look at the messages on its pendant: it names the line it does not understand.",
  );
export const noSuchLine = (name: string): Refusal =>
  refusal(
    "kuka.line",
    `“${name}” is no output of the controller.`,
    "Name it $OUT[1] to $OUT[4096], or $ANOUT[1] to $ANOUT[32].",
  );
export const noGripper = refusal(
  "kuka.gripper",
  "Which output the gripper hangs on is not given.",
  "Give the number of its output.",
);
export const rsiRests = refusal(
  "kuka.rsi-rests",
  "RSI does not run: nothing is heard from the controller's sensor interface.",
  "Reset the robot here, or select and start TWINCELL_RSI at the pendant.",
);
export const rsiEnded = refusal(
  "kuka.rsi-ended",
  "RSI ended before the motion did; the robot stopped.",
  "Look at the messages on the pendant, then reset the robot.",
);
export const onlySends = refusal(
  "kuka.rsi-only-sends",
  "The controller's RSI only sends; it takes no corrections.",
  "Set ONLYSEND to FALSE on both sides, or move the robot over its variables.",
);
export const notReached = (off_deg: number): Refusal =>
  refusal(
    "kuka.not-reached",
    `The robot stands ${off_deg.toFixed(3)}° beside its target.`,
    "Look whether the limits of the corrections are too narrow.",
  );
