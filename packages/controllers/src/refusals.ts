import { degrees, Fault, type Refusal, type Robot } from "@twincell/core";

/** Angles as people read them. */
export const inDegrees = (angle_rad: number): string => `${degrees(angle_rad).toFixed(1)}°`;

const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });

/** Why those joint angles cannot be a target of that robot; null when they can. */
export function jointRefusal(robot: Robot, q_rad: ArrayLike<number>): Refusal | null {
  const joints = robot.arm.joints;
  if (q_rad.length !== joints.length) {
    return refusal(
      "controller.joint-count",
      `${robot.name} has ${joints.length} joints but ${q_rad.length} angles were given.`,
      "Pass one angle per joint, base first.",
    );
  }
  for (let i = 0; i < joints.length; i++) {
    const value = q_rad[i]!;
    const { lower_rad, upper_rad } = joints[i]!.limits;
    if (!Number.isFinite(value)) {
      return {
        ...refusal(
          "controller.not-a-number",
          `Joint ${i + 1} was given ${value}, which is no angle.`,
          "Pass a finite angle in radians.",
        ),
        joint: i + 1,
      };
    }
    if (value < lower_rad - LIMIT_SLACK_RAD || value > upper_rad + LIMIT_SLACK_RAD) {
      const limit = value < lower_rad ? lower_rad : upper_rad;
      return {
        ...refusal(
          "limits.joint",
          `Joint ${i + 1} would turn to ${inDegrees(value)}; its limit is ${inDegrees(limit)}.`,
          `Keep joint ${i + 1} between ${inDegrees(lower_rad)} and ${inDegrees(upper_rad)}.`,
        ),
        joint: i + 1,
        value,
        limit,
      };
    }
  }
  return null;
}
/** A target on the limit stays on it after a round trip through degrees. */
const LIMIT_SLACK_RAD = 1e-9;

export function jointNumberRefusal(robot: Robot, joint: number): Refusal | null {
  const n = robot.arm.joints.length;
  return Number.isInteger(joint) && joint >= 1 && joint <= n
    ? null
    : refusal(
        "controller.no-such-joint",
        `${robot.name} has joints 1 to ${n}; joint ${joint} was asked for.`,
        "Count joints from 1, base first.",
      );
}

export const percentRefusal = (percent: number): Refusal | null =>
  percent >= 0 && percent <= 100
    ? null
    : refusal(
        "controller.speed",
        `The speed is 0 to 100 %; ${percent} was given.`,
        "Pass a percentage; 0 holds the robot where it is.",
      );

export const busy = (robot: Robot): Refusal =>
  refusal(
    "controller.busy",
    `${robot.name} is still carrying out the command before.`,
    "Wait until it is done, or stop it.",
  );
export const drivesOff = (robot: Robot): Refusal =>
  refusal(
    "safety.emergency-stop",
    `The drives of ${robot.name} are off after an emergency stop.`,
    "Reset the robot, then command the move again.",
  );
export const protective = (because: string): Refusal =>
  refusal(
    "safety.protective-stop",
    `The robot made a protective stop: ${because}`,
    "Clear the cause, reset the robot, then command the move again.",
  );
export const guardOpen = (robot: Robot): Refusal =>
  refusal(
    "safety.guard-stop",
    `The guard of ${robot.name} is open or somebody is near it.`,
    "Close the guard or step back, then command the move again.",
  );
export const manualMode = (robot: Robot): Refusal =>
  refusal(
    "controller.manual-mode",
    `${robot.name} is in manual mode: its teach pendant has it.`,
    "Turn the mode switch at the robot to automatic.",
  );
export const stoppedInReset = (robot: Robot): Refusal =>
  refusal(
    "controller.stopped-in-reset",
    `${robot.name} was stopped while it was being reset: the stop stays.`,
    "Reset it again when the way is clear.",
  );
export const stillBraking = (robot: Robot): Refusal =>
  refusal("controller.braking", `${robot.name} has not come to rest yet.`, "Reset it when it stands.");
export const guardStillOpen = (robot: Robot): Refusal =>
  refusal("safety.guard-stop", `The guard of ${robot.name} is still open.`, "Close the guard, then reset.");
export const closed = (name: string): Refusal =>
  refusal("controller.closed", `${name} was closed.`, "Open the cell again to get a new controller.");
export const stopped = (code: string, sentence: string): Refusal =>
  refusal(code, sentence, "Command the move again when the way is clear.");
export const programFault = (reason: unknown): Refusal =>
  reason instanceof Fault
    ? refusal(reason.code, reason.message, reason.hint)
    : refusal(
        "controller.program-fault",
        `The program ended with a fault of its own: ${reason instanceof Error ? reason.message : String(reason)}`,
        "Look at the line it came from.",
      );
