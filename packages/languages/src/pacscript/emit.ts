import { everyStep, type Capability, type Dialect, type Program } from "@twincell/core";
import { emitterOf } from "../emitter/index.ts";
import { GRIPPER } from "./robots.ts";
import { PacProgram } from "./write/program.ts";

/** What is written with other statements, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["timeout", "late", "wait-expression", "arguments", "truth-values"];
export const CANNOT: Dialect["cannot"] = [
  { what: "spline", because: "PacScript registers the points of a free curve apart from the motion." },
  { what: "duration", because: "PacScript gives motions a speed, not a time." },
  { what: "search", because: "MotionSkip ends a motion by a task that runs beside it." },
  { what: "set-analogue", because: "Analogue lines are an option of the controller." },
  { what: "read-analogue", because: "Analogue lines are an option of the controller." },
];

/** One file with `Main` and the subs that it calls, or the step that stands in the way: never a part of a program. */
export const emitPac = emitterOf({
  language: "PacScript",
  id: "pacscript",
  cannot: CANNOT,
  idioms: IDIOMS,
  write: (place, section) => new PacProgram(place, section).write(),
  warnings,
});

function warnings(program: Program): string[] {
  const said: string[] = [];
  const steps = [...everyStep(program)];
  if (steps.some(step => step.type === "move" && "pose" in step.target && step.target.branch !== undefined))
    said.push(
      "The figure of a place is taken as 1 for a wrist in front of axis 1, 2 for an elbow below, 4 for a joint 5 above 0; try the first motion slowly.",
    );
  if (steps.some(({ type }) => type === "gripper"))
    said.push(`The gripper is taken to close while IO[${GRIPPER.output}] is on.`);
  return said;
}
