import {
  lowered,
  type Capability,
  type Dialect,
  type Emitted,
  type Pose,
  type Program,
  type Robot,
} from "@twincell/core";
import { Place, tellsRobot, undeclared, writtenOr } from "../emitter/index.ts";
import { fullJointSpeed } from "./robots.ts";
import { ProgramWriter } from "./write/program.ts";

/** What is written with other statements, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["timeout", "late", "wait-expression", "arguments"];
export const CANNOT: Dialect["cannot"] = [
  { what: "spline", because: "URScript has no spline: movep cuts corners, and servoj needs a new point every 2 ms." },
  { what: "search", because: "URScript stops a move on a signal only from a second thread." },
  {
    what: "acceleration",
    because: "The greatest accelerations of these robots are not published, so a share of them cannot be written.",
  },
  { what: "pulse", because: "An output that falls back by itself needs a second thread." },
];

/** One script, or the step that stands in the way: never a part of a program. */
export function emitUrScript(taught: Program, robot: Robot, worldFromBase: Pose<"world", "base">): Emitted {
  const program = lowered(taught, { idioms: IDIOMS, cannot: CANNOT });
  if (fullJointSpeed(robot) === undefined) {
    return {
      kind: "cannot",
      step: "",
      sentence: `The controller of the ${robot.name} does not speak URScript.`,
      hint: "Export in the language of this robot's own controller.",
    };
  }
  const cannot = undeclared(program, CANNOT);
  if (cannot !== undefined) return cannot;
  return writtenOr(() => {
    const writer = new ProgramWriter(new Place(program, robot, worldFromBase));
    const file = writer.write();
    const hasGripper = file.text.includes("set_tool_digital_out(0, ");
    return {
      kind: "emitted",
      files: [file],
      warnings: [
        ...tellsRobot(program, robot),
        ...writer.warnings,
        ...(hasGripper ? ["The gripper is taken to close while output 0 at the tool is on."] : []),
      ],
    };
  });
}
