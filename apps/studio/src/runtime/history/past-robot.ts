import type { Robot } from "@twincell/core";
import { noteOther } from "../robot/drawn-robots.ts";

/** A robot of a recording that is not the one in the cell: written in place, read by the frame loop. */
export interface PastRobot {
  readonly robot: Robot;
  readonly q_rad: Float64Array;
  revision: number;
}

let past: PastRobot | null = null;
export const pastRobot = (): PastRobot | null => past;
export function showPast(robot: Robot, q_rad: ArrayLike<number>): void {
  if (past?.robot !== robot) past = { robot, q_rad: new Float64Array(robot.arm.joints.length), revision: 0 };
  past.q_rad.set(q_rad);
  past.revision++;
  noteOther();
}
export function leavePast(): void {
  past = null;
}
