import { withPredicateLines, type Step } from "@twincell/core";

/** A step with its lines by other names: those of a text become those of a controller's terminals. */
export function withLines(step: Step, nameOf: (signal: string) => string): Step {
  switch (step.type) {
    case "set":
      return { ...step, signal: nameOf(step.signal) };
    case "wait-for":
      return { ...step, when: withPredicateLines(step.when, nameOf) };
    case "move":
      return step.until
        ? { ...step, until: { ...step.until, when: withPredicateLines(step.until.when, nameOf) } }
        : step;
    default:
      return step;
  }
}
