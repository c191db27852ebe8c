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
import { Place, tellsRobot, undeclared, writtenOr } from "../emitter/index.ts";
import { GRIPPER_SIGNAL } from "./robots.ts";
import { ProgramWriter } from "./write/program.ts";

/** What is written with other statements, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["late", "wait-expression", "arguments"];
export const CANNOT: Dialect["cannot"] = [
  { what: "spline", because: "RAPID has no spline: zones pass beside the points." },
];
/** Modules with more moves than this take long to load. */
const MANY_MOVES = 5_000;

/** The module and the list that loads it, or the step that stands in the way: never a part of a program. */
export function emitRapid(taught: Program, robot: Robot, worldFromBase: Pose<"world", "base">): Emitted {
  const program = lowered(taught, { idioms: IDIOMS, cannot: CANNOT });
  const section = sectionForLanguage(robot, "rapid");
  if (section === undefined) {
    return {
      kind: "cannot",
      step: "",
      sentence: `The controller of the ${robot.name} does not speak RAPID.`,
      hint: "Export in the language of this robot's own controller.",
    };
  }
  const cannot = undeclared(program, CANNOT);
  if (cannot !== undefined) return cannot;
  return writtenOr(() => {
    const writer = new ProgramWriter(new Place(program, robot, worldFromBase), section);
    const files = writer.write();
    let moves = 0;
    let hasGripper = false;
    for (const { type } of everyStep(program)) {
      if (type === "move") moves++;
      if (type === "gripper") hasGripper = true;
    }
    return {
      kind: "emitted",
      files,
      warnings: [
        ...tellsRobot(program, robot),
        ...writer.warnings,
        ...(hasGripper
          ? [
              `The gripper is taken to close while the output ${GRIPPER_SIGNAL} is on; the controller's configuration must have it.`,
            ]
          : []),
        ...(moves > MANY_MOVES ? [`The module has ${moves} moves; more than ${MANY_MOVES} take long to load.`] : []),
      ],
    };
  });
}
