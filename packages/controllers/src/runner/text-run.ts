import type { Executed, Step } from "@twincell/core";
import { CYCLE_S, LINES_PER_CYCLE } from "./text.ts";

/**
 * One text on its way through a controller. A step that was begun and has not ended comes again when the text is taken
 * up after a stop; those that were looked ahead to stay behind it.
 */
export class TextRun {
  private readonly text: Iterator<Executed, void>;
  /** Handed out and not ended yet, oldest first. */
  private readonly open: { readonly step: Step; readonly line: number }[] = [];
  private count = 0;
  private idle = 0;
  /** The line of the oldest step that has not ended. */
  line = 0;

  constructor(text: Iterator<Executed, void>) {
    this.text = text;
  }

  /** Steps from here on: what is open first. */
  *rest(): Generator<Step, void> {
    for (const { step } of [...this.open]) yield step;
    for (let next = this.text.next(); !next.done; next = this.text.next()) {
      const { line, step } = next.value;
      // A text that only counts does not stop the clock.
      if (step !== undefined) {
        this.idle = 0;
        yield this.opened(step, line);
      } else if (++this.idle % LINES_PER_CYCLE === 0) yield this.opened({ id: "", type: "wait", s: CYCLE_S }, line);
    }
  }
  /** A step is being executed: those before it have ended. */
  reached(id: string): void {
    const at = this.open.findIndex(({ step }) => step.id === id);
    if (at < 0) return;
    this.open.splice(0, at);
    this.line = this.open[0]!.line;
  }

  private opened(step: Step, line: number): Step {
    const named = { ...step, id: `line ${line} #${++this.count}` };
    this.open.push({ step: named, line });
    return named;
  }
}
