import type { Executed, Step } from "@twincell/core";

export interface TextSteps {
  /** To be handed to `RobotController.run`; each iteration runs the text from its beginning. */
  readonly steps: Iterable<Step>;
  /** The line a step came from, counted from 1; 0 when it is not known. `JointSample.step` names the step. */
  lineOf(step: string): number;
}

/** So many lines without motion take one cycle of a controller: a text that only counts does not stop the clock. */
export const LINES_PER_CYCLE = 200;
export const CYCLE_S = 0.004;

/** The steps that a program text amounts to while it is being executed, statement by statement. */
export function textSteps(run: () => Iterator<Executed, void>): TextSteps {
  const lines = new Map<string, number>();
  return {
    lineOf: step => lines.get(step) ?? 0,
    steps: {
      *[Symbol.iterator]() {
        const text = run();
        let idle = 0;
        for (let next = text.next(); !next.done; next = text.next()) {
          const { line, step } = next.value;
          if (step) {
            idle = 0;
            // A text has no step ids of its own: its lines are its names.
            const named: Step = step.id === "" ? { ...step, id: `line ${line}` } : step;
            lines.set(named.id, line);
            yield named;
          } else if (++idle % LINES_PER_CYCLE === 0) {
            lines.set(`line ${line}`, line);
            yield { id: `line ${line}`, type: "wait", s: CYCLE_S };
          }
        }
      },
    },
  };
}
