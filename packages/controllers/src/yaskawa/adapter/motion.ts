import { branchOf, compose, inverse, type Pose, type Robot } from "@twincell/core";
import type { AdapterMotion } from "../../driver/index.ts";
import {
  CARTESIAN_PATH,
  COMMAND,
  MOVE_FRAME,
  PULSE_PATH,
  SERVICE,
  SPEED_CLASS,
  formOf,
  placeOf,
  pulsesOf,
  writeCartesianMove,
  writePulseMove,
  type PulseScale,
} from "../codec/index.ts";
import type { Question } from "./client.ts";

/** This far from a change of posture a posture word is certain [rad]; the joint is turned by it both ways. */
const CERTAIN_RAD = 0.02;
const MOST_RATIO = 10_000;
const MOST_LINEAR = 15_000;

export type Told = Omit<Question, "patience_s">;

/** Where a motion ends, in pulses. */
export const endOf = (motion: AdapterMotion, scale: PulseScale): Int32Array =>
  pulsesOf(motion.q_rad, scale, new Int32Array(8));

/** The command of a motion at that override; null for what no command says. */
export function commandOf(motion: AdapterMotion, robot: Robot, scale: PulseScale, override: number): Told | null {
  if (motion.path === "arc") return null;
  if (motion.path === "joints") {
    const speed = clamp(motion.ratio * override * MOST_RATIO, MOST_RATIO);
    return pulseMove(PULSE_PATH.joint, SPEED_CLASS.ratio, speed, endOf(motion, scale));
  }
  const speed = clamp(motion.speed_mps * override * 10_000, MOST_LINEAR);
  // A posture word at the border of two postures may be read either way; pulses cannot.
  if (!isCertain(robot, motion.q_rad))
    return pulseMove(PULSE_PATH.straight, SPEED_CLASS.linear, speed, endOf(motion, scale));
  const baseFromVendor = robot.baseFromVendorWorld as Pose as Pose<"base", "vendor-world">;
  const data = writeCartesianMove({
    robot: 1,
    station: 0,
    speedClass: SPEED_CLASS.linear,
    speed,
    frame: MOVE_FRAME.base,
    place: placeOf(compose(inverse(baseFromVendor), motion.baseFromFlange), new Int32Array(7)),
    form: formOf(robot, motion.q_rad),
    extendedForm: 0,
    tool: 0,
    user: 0,
  });
  return {
    command: COMMAND.moveCartesian,
    instance: CARTESIAN_PATH.straight,
    attribute: 1,
    service: SERVICE.setAll,
    data,
  };
}
const pulseMove = (path: number, speedClass: number, speed: number, axes: Int32Array): Told => ({
  command: COMMAND.movePulse,
  instance: path,
  attribute: 1,
  service: SERVICE.setAll,
  data: writePulseMove({ robot: 1, station: 0, speedClass, speed, axes, tool: 0 }),
});
const clamp = (value: number, most: number): number => Math.min(most, Math.max(1, Math.round(value)));

/** Whether the posture word stays the same a little to every side, and the posture has a name at all. */
export function isCertain(robot: Robot, q_rad: ArrayLike<number>): boolean {
  if (branchOf(robot, q_rad) === undefined) return false;
  const form = formOf(robot, q_rad);
  const near = Float64Array.from(q_rad);
  for (let i = 0; i < near.length; i++) {
    for (const by of [-CERTAIN_RAD, CERTAIN_RAD]) {
      near[i] = q_rad[i]! + by;
      if (formOf(robot, near) !== form) return false;
    }
    near[i] = q_rad[i]!;
  }
  return true;
}
