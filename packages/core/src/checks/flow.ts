import { predicateLines, predicateVariables } from "../program/predicate.ts";
import type { Program, RepeatStep, Step, WhileStep } from "../program/program.ts";
import { everyIn, everyStep } from "../program/walk.ts";
import { startOf, type CheckScene } from "./scene.ts";

/** Steps the program never comes to, and loops without end that let no time pass. */
export function checkFlow(scene: CheckScene): void {
  const { program, layout } = scene;
  for (const { step, why, at_s } of layout.failures)
    scene.add(step.id, "bad", {
      code: why.code,
      value: 0,
      limit: 0,
      unit: "1",
      at_s,
      sentence: why.sentence,
      repairs: [],
    });
  const warn = (step: Step, code: string, sentence: string): void => {
    scene.add(step.id, "warn", {
      code,
      value: 0,
      limit: 0,
      unit: "1",
      at_s: startOf(scene, step.id),
      sentence,
      repairs: [],
    });
  };
  for (const step of everyStep(program)) {
    if (isEndless(step) && !takesTime(program, step.steps))
      warn(step, "flow.idle-loop", "The loop goes round for ever without a motion or a wait.");
    if (layout.complete && !layout.evaluated.has(step.id))
      warn(step, "flow.unreached", "The program never comes to this step.");
  }
}

/** A loop that nothing in its condition ends. */
const isEndless = (step: Step): step is RepeatStep | WhileStep =>
  (step.type === "repeat" && step.times === "forever") ||
  (step.type === "while" && predicateLines(step.when).length + predicateVariables(step.when).size === 0);

/** A routine never calls itself, so this comes to an end. */
function takesTime(program: Pick<Program, "routines">, steps: readonly Step[]): boolean {
  for (const step of everyIn(steps)) {
    if (
      step.type === "move" ||
      step.type === "gripper" ||
      step.type === "wait-for" ||
      step.type === "stop" ||
      (step.type === "wait" && step.s > 0)
    )
      return true;
    if (step.type === "call" && takesTime(program, program.routines[step.routine] ?? [])) return true;
  }
  return false;
}
