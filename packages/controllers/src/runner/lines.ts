import type { Condition, Step } from "@twincell/core";

/** A step with its lines by other names: those of a text become those of a controller's terminals. */
export function withLines(step: Step, nameOf: (signal: string) => string): Step {
  const when = <T extends Condition>(condition: T): T => ({ ...condition, signal: nameOf(condition.signal) });
  switch (step.type) {
    case "set":
      return { ...step, signal: nameOf(step.signal) };
    case "wait-for":
      return { ...step, when: when(step.when) };
    case "move":
      return step.until ? { ...step, until: { ...step.until, when: when(step.until.when) } } : step;
    default:
      return step;
  }
}
