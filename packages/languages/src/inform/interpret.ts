import type { Executed, Interpreted, Pose, Robot, Signals, TextFault, TextPlace } from "@twincell/core";
import { TextError, textFault } from "../text/index.ts";
import { readSource } from "./read/source.ts";
import type { PulseData } from "./robots.ts";
import { Arm } from "./run/arm.ts";
import { Machine, WaitsOutside } from "./run/machine.ts";
import { ControllerState, type Context } from "./run/state.ts";

/**
 * How far a job is run beforehand to meet its tools and its faults: enough to see that it runs on the spot.
 * A job that moves for ever goes on longer.
 */
const BEFOREHAND = { steps: 5_000, statements: 150_000 } as const;

/** Jobs ready to be executed, with what only their reader wants to know. */
export type Opened =
  | { readonly kind: "opened"; readonly context: Context; readonly start: (signals?: Signals) => Run }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };
export interface Run { readonly steps: Generator<Executed, void>; readonly assumed: ReadonlyMap<string, TextPlace> }

export function openInform(text: string, robot: Robot, worldFromBase: Pose<"world", "base">, pulses: PulseData | undefined): Opened {
  const arm = Arm.of(robot);
  if (arm === undefined) {
    return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks INFORM", `How INFORM counts the axes of the ${robot.name} is not known.`)] };
  }
  const read = readSource(text);
  if (read.kind === "not-understood") return read;
  const context: Context = { tools: {}, frames: {}, signals: {} };
  const start = (signals?: Signals): Run => {
    const state = new ControllerState(robot, arm, read.source, worldFromBase, context, pulses?.pulsesPerDegree), machine = new Machine(read.source, state, signals, context.signals);
    return { steps: machine.run(), assumed: state.assumed };
  };
  return { kind: "opened", context, start };
}

/** Executes INFORM jobs, the first one of the text, with tools and user frames where the text has them. */
export function interpretInform(text: string, robot: Robot, worldFromBase: Pose<"world", "base">, pulses: PulseData | undefined): Interpreted {
  const opened = openInform(text, robot, worldFromBase, pulses);
  if (opened.kind === "not-understood") return opened;
  try {
    let steps = 0, statements = 0;
    for (const { step } of opened.start().steps) {
      if (step !== undefined) steps++;
      if (steps >= BEFOREHAND.steps || ++statements >= BEFOREHAND.statements) break;
    }
  } catch (cause) {
    // What hangs on a line from outside shows only when the job runs.
    if (cause instanceof TextError) return { kind: "not-understood", faults: [cause.fault] };
    if (!(cause instanceof WaitsOutside)) throw cause;
  }
  return { kind: "ready", run: signals => opened.start(signals).steps, context: opened.context };
}
