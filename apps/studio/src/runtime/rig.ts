import { identity, pose, robotOfFile, transformMesh, type Pose, type Robot } from "@twincell/core";
import type { Rig } from "@twincell/formats";
import { shapeMesh } from "@twincell/project";
import { words } from "../messages/index.ts";
import { chooseTool } from "../stores/build.ts";
import { cellStore } from "../stores/cell.ts";
import { controlStore } from "../stores/control.ts";
import { notify } from "../stores/notices.ts";
import { keepRobotFile, knowRobotFile, type KeptRobotFile } from "../stores/own-robots.ts";
import { clearRig, linkOf, rigName, rigObjects, rigStore } from "../stores/rig.ts";
import { changeRobot } from "../stores/robot.ts";
import { select } from "../stores/selection.ts";
import { askShapes } from "./mesh-import.ts";
import { saveRobotFile, saveUrdf } from "./robot-files.ts";

/** What becomes of the robot: that of the cell, or a file. */
export type RigUse = "cell" | "robot-file" | "urdf";

/** The robot of what was picked, computed away from the page. A rig that is none is said in one sentence. */
export async function finishRig(use: RigUse): Promise<void> {
  const state = rigStore.getState();
  const { document } = cellStore.getState();
  if (!document || state.busy) return;
  const members = rigObjects(document, state).filter(({ id }) => linkOf(state, id) >= 0);
  const rig: Rig = {
    name: rigName(state),
    density_kgm3: state.density_kgm3,
    joints: state.axes.map(({ name, kind, through_m, axis, lower, upper, speed }) => ({
      name,
      kind,
      through_m,
      axis,
      lower,
      upper,
      speed,
    })),
    parts: members.map(({ id, name, color, shape, worldFromObject }) => ({
      name,
      color,
      mesh: transformMesh(shapeMesh(shape), worldFromObject as Pose),
      link: linkOf(state, id),
    })),
    ...(state.flange ? { flange: state.flange } : {}),
  };
  rigStore.setState({ busy: true });
  const answer = await askShapes({ kind: "rig", rig }).finally(() => rigStore.setState({ busy: false }));
  if (answer?.kind === "not-understood") notify("bad", answer.sentence);
  if (answer?.kind !== "rigged") return;
  const robot = robotOf(answer.file);
  if (!robot) return;
  if (use === "urdf") await saveUrdf(robot);
  else if (use === "robot-file") saveRobotFile(answer.file, robot);
  else await intoCell(answer.file, answer.worldFromBase, new Set(members.map(({ id }) => id)));
}

function robotOf(file: KeptRobotFile): Robot | undefined {
  const read = robotOfFile(file);
  return read.kind === "robot" ? read.robot : undefined;
}

/** The robot takes the place of its parts, as one step of undo. */
async function intoCell(
  file: KeptRobotFile,
  worldFromBase: Pose<"world", "base">,
  members: ReadonlySet<string>,
): Promise<void> {
  const robot = knowRobotFile(file);
  if (!robot) return;
  if (controlStore.getState().running) {
    notify("warn", words.own.kept(robot.name), words.robots.busy);
  } else {
    changeRobot(robot.id, {
      worldFromBase: pose(worldFromBase.position, worldFromBase.quaternion ?? identity().quaternion),
      without: members,
    });
    clearRig();
    chooseTool("select");
    select({ kind: "robot" });
  }
  try {
    await keepRobotFile(file);
  } catch (problem) {
    notify("warn", words.own.notKept(robot.name), problem instanceof Error ? problem.message : String(problem));
  }
}
