import {
  everyStep,
  lowered,
  type Capability,
  sectionForLanguage,
  type Dialect,
  type Emitted,
  type Pose,
  type Program,
  type Robot,
} from "@twincell/core";
import { Place, linesLookedAt, tellsRobot, undeclared, writtenOr } from "../emitter/index.ts";
import { VALVE } from "./robots.ts";
import { ApplicationWriter } from "./write/program.ts";

/** What is written with other statements, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["late", "wait-expression", "arguments"];
export const CANNOT: Dialect["cannot"] = [
  { what: "spline", because: "VAL 3 blends between points and has no spline." },
  { what: "duration", because: "VAL 3 gives a motion limits of speed and no duration." },
  { what: "search", because: "VAL 3 ends a motion on a line only from a second task." },
  { what: "pulse", because: "An output that falls back by itself needs a second task." },
  { what: "payload", because: "The load of the arm is a setting of the controller, not of a program." },
];

/** The files of an application, or the step that stands in the way: never a part of a program. */
export function emitVal3(taught: Program, robot: Robot, worldFromBase: Pose<"world", "base">): Emitted {
  const program = lowered(taught, { idioms: IDIOMS, cannot: CANNOT });
  const section = sectionForLanguage(robot, "val3");
  if (section === undefined)
    return {
      kind: "cannot",
      step: "",
      sentence: `The controller of the ${robot.name} does not speak VAL 3.`,
      hint: "Export in the language of this robot's own controller.",
    };
  const cannot = undeclared(program, CANNOT);
  if (cannot !== undefined) return cannot;
  return writtenOr(() => {
    const files = new ApplicationWriter(new Place(program, robot, worldFromBase), section).write();
    const steps = [...everyStep(program)];
    const title = files.at(-1)!.name.replace(/\.pjx$/, "");
    const usesLines = steps.some(step => step.type === "set" || [...linesLookedAt(step)].length > 0);
    return {
      kind: "emitted",
      files,
      warnings: [
        ...tellsRobot(program, robot),
        `All files belong into one folder with the name ${title}.`,
        ...(steps.some(({ type }) => type === "gripper")
          ? [`The gripper is the valve ${VALVE}: link the tool to that of your cell.`]
          : []),
        ...(usesLines ? ["Lines are variables by their names: link each to its line in the controller."] : []),
      ],
    };
  });
}
