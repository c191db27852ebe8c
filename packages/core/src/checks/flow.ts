import type { Program, Step } from "../program/program.ts";
import { everyIn, everyStep } from "../program/walk.ts";
import { startOf, type CheckScene } from "./scene.ts";

/** Steps the program never comes to, and loops without end that let no time pass. */
export function checkFlow(scene: CheckScene): void {
  const { program, layout } = scene;
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
    if (step.type === "repeat" && step.times === "forever" && !takesTime(program, step.steps))
      warn(step, "flow.idle-loop", "The loop goes round for ever without a motion or a wait.");
    if (layout.complete && !layout.evaluated.has(step.id))
      warn(step, "flow.unreached", "The program never comes to this step.");
  }
}

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
