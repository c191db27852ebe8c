import { emptyProgram, type Program, type Robot, type Step } from "@twincell/core";
import type { Given } from "./arguments.ts";

/** A program of one step: the connection plans, checks and guards it like any other. */
export const oneStepProgram = (robot: Robot, name: string, step: Step): Program => ({
  ...emptyProgram(robot.id, name),
  steps: [step],
});

/** `--despite A,B`. */
export const codesOf = (options: Given): string[] =>
  (options.text("despite") ?? "")
    .split(",")
    .map(code => code.trim())
    .filter(code => code !== "");
