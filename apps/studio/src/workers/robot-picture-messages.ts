import type { Pixels } from "../runtime/pictures/robot-picture.ts";

export interface ToRobotPainter {
  readonly id: number;
  /** Id of a robot of library or catalogue. */
  readonly robot: string;
  readonly width: number;
  readonly height: number;
}
/** No picture: the robot is not known. */
export interface FromRobotPainter {
  readonly id: number;
  readonly picture: Pixels | null;
}
