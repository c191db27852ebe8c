import { emptyProgram, pose } from "@twincell/core";
import type { StepsCell } from "../document.ts";

/** A robot alone on the floor, with nothing taught. */
export function emptyCell(robot = "staubli_rx90l", name = "New cell"): StepsCell {
  return {
    format: "twincell.cell",
    version: 2,
    name,
    robot: { id: robot, worldFromBase: pose() },
    tools: [],
    tool: "flange",
    objects: [],
    frames: [],
    allowedPairs: [],
    programs: [emptyProgram(robot)],
    program: "Program",
  };
}
