import { isCondition } from "./predicate.ts";
import type { Program, Step } from "./program.ts";
import { everyStep } from "./walk.ts";

/**
 * The lowest version of the format that can say this program: a program without variables and expressions stays the
 * version 1 that every release reads.
 */
export function versionOf(program: Program): Program["version"] {
  const isNew = (step: Step): boolean => {
    switch (step.type) {
      case "assign":
      case "while":
        return true;
      case "if":
        return !isCondition(step.when);
      case "wait-for":
        return step.late !== undefined || !isCondition(step.when);
      case "call":
        return step.arguments !== undefined;
      default:
        return false;
    }
  };
  const hasTables = [program.variables, program.parameters].some(table => Object.keys(table ?? {}).length > 0);
  return hasTables || Array.from(everyStep(program)).some(isNew) ? 2 : 1;
}
