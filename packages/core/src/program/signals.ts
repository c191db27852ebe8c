import { PlainFault } from "../fault.ts";
import type { Signals } from "../signals.ts";
import { evaluate, type ExpressionValues } from "./expression/evaluate.ts";
import type { Predicate } from "./program.ts";

/**
 * Whether a condition is true now. A digital line counts as 0 or 1 beside a level, an analogue one as on when it is not
 * 0.
 *
 * @param variable  what variables are worth; none exist when left out.
 */
export function holds(
  when: Predicate,
  signals: Pick<Signals, "read">,
  variable: ExpressionValues["variable"] = () => undefined,
): boolean {
  if ("expression" in when) {
    const answer = evaluate(when.expression, { variable, signal: name => signals.read(name) });
    if (answer.kind === "value") return answer.value === true || (answer.value !== false && answer.value !== 0);
    throw new PlainFault(
      "program.expression",
      answer.kind === "failed" ? answer.sentence : "The condition looks at a variable that has no value here.",
      "Look at the expression of the step.",
    );
  }
  const value = signals.read(when.signal);
  if ("is" in when) return (typeof value === "number" ? value !== 0 : value) === when.is;
  const level = typeof value === "number" ? value : value ? 1 : 0;
  return "above" in when ? level > when.above : level < when.below;
}

/** Lines that only remember: what a program writes is what it reads. */
export class SignalTable implements Signals {
  private readonly values: Map<string, boolean | number>;
  constructor(values: Iterable<readonly [string, boolean | number]> = []) {
    this.values = new Map(values);
  }
  read(signal: string): boolean | number {
    return this.values.get(signal) ?? false;
  }
  write(signal: string, value: boolean | number): void {
    this.values.set(signal, value);
  }
  /** Every line that was ever written to; changes with them. */
  get all(): ReadonlyMap<string, boolean | number> {
    return this.values;
  }
}
