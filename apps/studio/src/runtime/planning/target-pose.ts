import { compose, flangePose, identity, type Pose, type Program, type Robot, type Target } from "@twincell/core";
import type { CellDocument } from "@twincell/project";

/** Where a target brings the tool, in the world; undefined where its frame or its joints are not those of the cell. */
export function worldFromTarget(
  document: CellDocument,
  program: Program,
  robot: Robot,
  target: Target,
): Pose<"world", "tcp"> | undefined {
  if ("q" in target) {
    if (target.q.length !== robot.arm.joints.length) return undefined;
    const name = target.tool ?? document.tool;
    const flangeFromTcp: Pose<"flange", "tcp"> =
      program.tools[name] ?? document.tools.find(tool => tool.name === name)?.flangeFromTcp ?? identity();
    return compose(compose(document.robot.worldFromBase, flangePose(robot.arm, target.q)), flangeFromTcp);
  }
  const frame: Pose<"world", "frame"> | undefined =
    target.frame === "world"
      ? identity()
      : (program.frames[target.frame] ?? document.frames.find(each => each.name === target.frame)?.worldFromFrame);
  return frame && compose(frame, target.pose);
}
