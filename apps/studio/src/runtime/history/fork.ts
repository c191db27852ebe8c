import { everyStep, type Program, type Signals, type Step } from "@twincell/core";
import type { Moment } from "@twincell/recording";

/**
 * A past instant that a run goes on from: which step was under way, and how gripper and lines stood. The posture is
 * that of the robot on screen.
 */
export interface Branch {
  /** "" begins with the first step. */
  readonly step: string;
  readonly gripperClosed: boolean;
  readonly signals: Readonly<Record<string, boolean | number>>;
}

/** The branch of a moment; its step is kept only where the program still has it. */
export function branchOf(
  { state: { step, gripperClosed }, signals }: Pick<Moment, "state" | "signals">,
  program: Program,
): Branch {
  const known = [...everyStep(program)].some(({ id }) => id === step);
  return { step: known ? step : "", gripperClosed, signals };
}

/**
 * The gripper as it was, then the steps from that one on. What came before it is passed over, decisions seeing the
 * lines as they are now.
 */
export function* stepsFrom(steps: Iterable<Step>, { step, gripperClosed }: Branch): Generator<Step> {
  let passing = step !== "";
  let first = true;
  for (const each of steps) {
    if (passing && each.id !== step) continue;
    passing = false;
    if (first) yield { id: each.id, type: "gripper", closed: gripperClosed };
    first = false;
    yield each;
  }
}

/** Sets the lines to what they were: inputs from outside, outputs by themselves. */
export function restoreSignals(
  { signals }: Branch,
  program: Pick<Program, "signals">,
  lines: Signals,
  setInput: (signal: string, value: boolean | number) => void,
): void {
  for (const [name, value] of Object.entries(signals)) {
    if (program.signals[name]?.kind.endsWith("-in")) setInput(name, value);
    else lines.write(name, value);
  }
}
