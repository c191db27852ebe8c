import type { Executed, Interpreted, Pose, Robot } from "@twincell/core";
import { readPoseList } from "./read/list.ts";

/** Executes a list: its motions, waits and gripper actions in their order. Poses that are only named move nothing. */
export function interpretPoseList(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
  const read = readPoseList(text, robot, worldFromBase);
  if (read.kind === "not-understood") return read;
  const { steps, tools, frames } = read.list;
  function* run(): Generator<Executed, void> {
    for (const { line, step } of steps) yield step.type === "comment" ? { line } : { line, step };
  }
  return {
    kind: "ready",
    run,
    context: { tools: Object.fromEntries(tools), frames: Object.fromEntries(frames), signals: {} },
  };
}
