import { everyStep, type Capability, type Dialect, type Program } from "@twincell/core";
import { emitterOf } from "../emitter/index.ts";
import { MelfaProgram } from "./write/program.ts";

/** What is written with other statements, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["timeout", "late", "wait-expression", "arguments", "truth-values"];
export const CANNOT: Dialect["cannot"] = [
  {
    what: "spline",
    because: "MELFA-BASIC keeps a spline in a file of its own, of which the text says only the number.",
  },
  { what: "duration", because: "MELFA-BASIC gives motions a speed, not a time." },
  { what: "search", because: "A motion that is skipped by WthIf goes on without a fault when its line never comes." },
  { what: "payload", because: "LoadSet chooses a load by the number of a parameter of the controller." },
  { what: "message", because: "Print writes to a line that is opened, not to the pendant." },
  { what: "set-analogue", because: "Analogue lines are an option of the controller." },
  { what: "read-analogue", because: "Analogue lines are an option of the controller." },
];

/**
 * One file with the program, its routines and its positions, or the step that stands in the way: never a part of a
 * program.
 */
export const emitMelfa = emitterOf({
  language: "MELFA-BASIC",
  id: "melfa-basic",
  cannot: CANNOT,
  idioms: IDIOMS,
  write: (place, section) => new MelfaProgram(place, section).write(),
  warnings,
});

function warnings(program: Program): string[] {
  const said: string[] = [];
  const steps = [...everyStep(program)];
  if (steps.some(step => step.type === "move" && "pose" in step.target))
    said.push(
      "The first flag of a position is taken as 4 for a wrist in front of joint 1, 2 for a forearm folded forwards, 1 for a joint 5 above 0; try the first motion slowly.",
    );
  if (steps.some(({ type }) => type === "gripper"))
    said.push("The gripper is taken to be hand 1: HClose closes it, HOpen opens it.");
  return said;
}
