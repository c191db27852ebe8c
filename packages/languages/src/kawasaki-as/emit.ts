import {
  everyStep,
  lowered,
  sectionForLanguage,
  type Capability,
  type Dialect,
  type Emitted,
  type Pose,
  type Program,
  type Robot,
} from "@twincell/core";
import { Place, tellsRobot, undeclared, writtenOr } from "../emitter/index.ts";
import { ProgramWriter } from "./write/program.ts";

/** What is written with other statements, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["timeout", "late", "wait-expression", "arguments", "truth-values"];
export const CANNOT: Dialect["cannot"] = [
  { what: "spline", because: "AS moves on joint-interpolated, straight and circular paths only." },
  { what: "search", because: "AS stops a move on a signal by options of the controller that not every robot has." },
  {
    what: "set-analogue",
    because: "Analogue lines are an option of the controller, reached by instructions of the board.",
  },
  {
    what: "read-analogue",
    because: "Analogue lines are an option of the controller, reached by instructions of the board.",
  },
];

/** One file with the program and its routines, or the step that stands in the way: never a part of a program. */
export function emitAs(taught: Program, robot: Robot, worldFromBase: Pose<"world", "base">): Emitted {
  const program = lowered(taught, { idioms: IDIOMS, cannot: CANNOT });
  const section = sectionForLanguage(robot, "kawasaki-as");
  if (section === undefined) {
    return {
      kind: "cannot",
      step: "",
      sentence: `The controller of the ${robot.name} does not speak AS.`,
      hint: "Export in the language of this robot's own controller.",
    };
  }
  const cannot = undeclared(program, CANNOT);
  if (cannot !== undefined) return cannot;
  return writtenOr(() => {
    const writer = new ProgramWriter(new Place(program, robot, worldFromBase), section);
    const file = writer.write();
    return { kind: "emitted", files: [file], warnings: [...tellsRobot(program, robot), ...warnings(program)] };
  });
}

function warnings(program: Program): string[] {
  const said: string[] = [];
  const steps = [...everyStep(program)];
  if (steps.some(step => step.type === "move" && step.path === "ptp" && "mps" in step.speed)) {
    said.push("AS holds a speed in mm/s on straight paths and arcs: on joint motions it is a guide only.");
  }
  if (steps.some(step => step.type === "move" && "pose" in step.target && step.target.branch !== undefined)) {
    said.push(
      "RIGHTY is taken for a wrist in front of the shoulder axis, LEFTY for one behind it, UWRIST for a JT5 above 0; try the first motion slowly.",
    );
  }
  if (steps.some(({ type }) => type === "gripper"))
    said.push("The gripper is taken to be clamp 1: CLOSEI closes it, OPENI opens it.");
  return said;
}
