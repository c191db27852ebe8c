import {
  everyStep,
  lowered,
  type Capability,
  type Dialect,
  type Emitted,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  sectionForLanguage,
} from "@twincell/core";
import { Place, TooLong, inParts, tellsRobot, undeclared, writtenOr } from "../emitter/index.ts";
import { GRIPPER_OUTPUT } from "./robots.ts";
import { ProgramWriter } from "./write/program.ts";

/** What is written with other statements, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["late", "wait-expression", "arguments", "truth-values"];
export const CANNOT: Dialect["cannot"] = [
  { what: "spline", because: "TP passes points by CNT and has no spline." },
  {
    what: "duration",
    because:
      "TP rounds the duration of a motion to tenths of a second or whole milliseconds, which is no speed to compute with.",
  },
  {
    what: "payload",
    because: "A program only chooses a payload schedule; the masses in it are settings of the controller.",
  },
];
/** Steps of a part: with frame, tool, names and both lines of an arc they have fewer lines than a listing numbers. */
const MOST_STEPS = 1500;
/** The controller's constant path works on speeds up to here. */
export const FASTEST_MMPS = 2000;

/** The programs, one file each, or the step that stands in the way: never a part of a program. */
export function emitFanucLs(taught: Program, robot: Robot, worldFromBase: Pose<"world", "base">): Emitted {
  const program = lowered(taught, { idioms: IDIOMS, cannot: CANNOT });
  const convention = sectionForLanguage(robot, "fanuc-ls");
  if (convention === undefined) {
    return {
      kind: "cannot",
      step: "",
      sentence: `The controller of the ${robot.name} does not speak FANUC TP.`,
      hint: "Export in the language of this robot's own controller.",
    };
  }
  const cannot = undeclared(program, CANNOT);
  if (cannot !== undefined) return cannot;
  const written = (whole: Program, more: readonly string[]): Emitted => {
    const writer = new ProgramWriter(new Place(whole, robot, worldFromBase), convention, FASTEST_MMPS);
    const files = writer.write();
    return {
      kind: "emitted",
      files,
      warnings: [...tellsRobot(program, robot), ...more, ...writer.warnings, ...warnings(program)],
    };
  };
  return writtenOr(() => {
    try {
      return written(program, []);
    } catch (cause) {
      if (!(cause instanceof TooLong)) throw cause;
      const parts = inParts(program, MOST_STEPS);
      return written(parts, [
        `The program is longer than one listing: it was written as ${1 + Object.keys(parts.routines).length} programs that are called one after the other.`,
      ]);
    }
  });
}

function warnings(program: Program): string[] {
  const said: string[] = [];
  const steps = [...everyStep(program)];
  const moves = steps.filter((step): step is MoveStep => step.type === "move");
  if (steps.some(({ type }) => type === "gripper"))
    said.push(`The gripper is written to ${GRIPPER_OUTPUT}, ON closes: change it to the output of your hand.`);
  if (moves.some(({ blend_m }) => blend_m > 0))
    said.push(
      "CNT is no radius: how far a corner is cut depends on the speed. Zones in mm became shares of the shorter neighbouring half path.",
    );
  if (moves.some(({ speed, path }) => "mps" in speed && path === "ptp"))
    said.push(
      "Joint motions have a share of the joint speeds: a speed in mm/s became its share of the tool's full speed.",
    );
  if (moves[0] !== undefined && moves[0].path !== "ptp")
    said.push("The first motion is no joint motion: where it starts depends on where the robot stands.");
  said.push("Loading a .LS file needs the ASCII upload option of the controller, or a conversion to .TP.");
  return said;
}
