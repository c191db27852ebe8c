import type { Pose } from "@twincell/core";
import { theLive } from "../live.ts";

/** An arm as it is to be drawn. */
export interface ShownArm {
  readonly q_rad: ArrayLike<number>;
  readonly revision: number;
}
export interface ShownRobot extends ShownArm {
  readonly baseFromFlange: Pose<"base", "flange">;
}

let robot: ShownRobot | null = null;
let othersMoved = 0;
const others = new Map<string, ShownArm>();

/**
 * The robot of the cell as it is to be drawn: as it is, unless somebody shows it as it was. Drawn, not commanded: who
 * commands asks `theLive`.
 */
export const shownRobot = (): ShownRobot => robot ?? theLive();
/** Another controller's robot as somebody shows it instead of as it is. */
export const shownInstead = (id: string): ShownArm | undefined => others.get(id);

/** Revisions of what is shown instead are negative, so that going back is a change too. */
export function showRobotInstead(arm: ShownRobot | null): void {
  robot = arm;
}
export function showOtherInstead(id: string, arm: ShownArm | null): void {
  if (arm) others.set(id, arm);
  else others.delete(id);
  othersMoved++;
}

/**
 * Counts up with every change of an arm that is not the cell's own: another controller's, a ghost, one of the past. The
 * frame loop draws when it has.
 */
export const othersRevision = (): number => othersMoved;
export function noteOther(): void {
  othersMoved++;
}
