import { everyStep, type Capability, type Dialect, type Program } from "@twincell/core";
import { emitterOf } from "../emitter/index.ts";
import { GRIPPER } from "./robots.ts";
import { SpelProgram } from "./write/program.ts";

/** What is written with other statements, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["timeout", "late", "wait-expression", "arguments", "truth-values"];
export const CANNOT: Dialect["cannot"] = [
  { what: "spline", because: "SPEL+ keeps a curve in a file of its own, of which the text says only the name." },
  { what: "duration", because: "SPEL+ gives motions a speed, not a time." },
  { what: "acceleration", because: "SPEL+ gives paths an acceleration in mm/s², not a share of the fastest." },
  { what: "search", because: "A motion with Till goes on without a fault when its line never comes." },
  {
    what: "payload",
    because:
      "Weight and Inertia take a distance from an axis, not a place, and belong to the stored data of the controller.",
  },
  { what: "set-analogue", because: "Analogue lines are an option of the controller." },
  { what: "read-analogue", because: "Analogue lines are an option of the controller." },
];

/**
 * One file with `main` and the functions that it calls, or the step that stands in the way: never a part of a program.
 */
export const emitSpel = emitterOf({
  language: "SPEL+",
  id: "spel",
  cannot: CANNOT,
  idioms: IDIOMS,
  write: (place, section) => new SpelProgram(place, section).write(),
  warnings,
});

function warnings(program: Program): string[] {
  const said: string[] = [];
  const steps = [...everyStep(program)];
  if (steps.some(step => step.type === "move" && (step.blend_m > 0 || (step.blend_ratio ?? 0) > 0)))
    said.push("SPEL+ passes a point as near as its speed needs: the text says CP, and no distance.");
  if (steps.some(step => step.type === "move" && step.path === "ptp"))
    said.push("Joint motions have whole percents of speed, from 1 to 100.");
  if (steps.some(step => step.type === "move" && "pose" in step.target && step.target.branch !== undefined))
    said.push(
      "R is taken for a wrist in front of joint 1, A for an elbow above, NF for a joint 5 below 0; try the first motion slowly.",
    );
  if (steps.some(({ type }) => type === "gripper"))
    said.push(`The gripper is taken to close while the output ${GRIPPER.output} is on.`);
  return said;
}
