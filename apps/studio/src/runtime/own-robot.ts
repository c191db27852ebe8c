import { words } from "../messages/index.ts";
import { keepRobotFile, knowRobotFile, type KeptRobotFile } from "../stores/own-robots.ts";
import { notify } from "../stores/notices.ts";
import { changeRobot } from "../stores/robot.ts";
import { controlStore } from "../stores/control.ts";

/**
 * A robot from a file becomes the robot of the open cell, as one edit, and is kept in this browser for other cells.
 * While a robot runs a program it is only kept: the chooser has it.
 */
export async function takeRobotFile(file: KeptRobotFile): Promise<void> {
  const robot = knowRobotFile(file);
  if (!robot) return;
  if (controlStore.getState().running) notify("warn", words.own.kept(robot.name), words.robots.busy);
  else if (!changeRobot(robot.id)) notify("info", words.robots.already);
  try {
    await keepRobotFile(file);
  } catch (problem) {
    notify("warn", words.own.notKept(robot.name), problem instanceof Error ? problem.message : String(problem));
  }
}
