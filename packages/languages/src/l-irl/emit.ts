import type { Emitted, Pose, Program, Robot } from "@twincell/core";
import { undeclared, writtenOr } from "../emitter/index.ts";
import { CANNOT } from "./words.ts";
import { ListWriter } from "./write.ts";

/** The list of a program, or the step that stands in the way: never a part of a program. */
export function emitPoseList(program: Program, robot: Robot, worldFromBase: Pose<"world", "base">): Emitted {
  if (program.robot !== robot.id) {
    return {
      kind: "cannot",
      step: "",
      sentence: `The program was taught on ${program.robot}, and joint values of a pose list are those of one robot: the ${robot.name} is another.`,
      hint: "Retarget the program to this robot first.",
    };
  }
  return (
    undeclared(program, CANNOT) ??
    writtenOr(() => ({ kind: "emitted", files: [new ListWriter(program, robot, worldFromBase).write()], warnings: [] }))
  );
}
