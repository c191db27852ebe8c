import type { Executed, Interpreted, Pose, Robot, Signals, TextFault, TextPlace } from "@twincell/core";
import { Notices, dryRun, strangeRobot, type DeclaredCell, createDeclaredCell } from "../parser/index.ts";
import { readSource } from "./read/source.ts";
import type { PulseData } from "./pulses.ts";
import { Arm } from "./run/arm.ts";
import { Machine } from "./run/machine.ts";
import { ControllerState } from "./run/state.ts";

/** Jobs ready to be executed, with what only their reader wants to know. */
export type Opened =
  | {
      readonly kind: "opened";
      readonly context: DeclaredCell;
      readonly start: (signals?: Signals, notices?: Notices) => Run;
    }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };
export interface Run {
  readonly steps: Generator<Executed, void>;
  readonly assumed: ReadonlyMap<string, TextPlace>;
}

export function openInform(
  text: string,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  pulses: PulseData | undefined,
): Opened {
  const arm = Arm.of(robot);
  if (arm === undefined) {
    return strangeRobot(robot, "INFORM", "axes");
  }
  const read = readSource(text);
  if (read.kind === "not-understood") return read;
  const context: DeclaredCell = createDeclaredCell();
  const start = (signals?: Signals, notices?: Notices): Run => {
    const state = new ControllerState(
      robot,
      arm,
      read.source,
      worldFromBase,
      context,
      pulses?.pulsesPerDegree,
      notices,
    );
    const machine = new Machine(read.source, state, signals, context.signals, notices);
    return { steps: machine.run(), assumed: state.assumed };
  };
  return { kind: "opened", context, start };
}

/** Executes INFORM jobs, the first one of the text, with tools and user frames where the text has them. */
export function interpretInform(
  text: string,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  pulses: PulseData | undefined,
): Interpreted {
  const opened = openInform(text, robot, worldFromBase, pulses);
  if (opened.kind === "not-understood") return opened;
  const ready = executable(opened);
  const fault = dryRun({ [Symbol.iterator]: () => ready.run() as Generator<Executed, void> });
  return fault === undefined ? ready : { kind: "not-understood", faults: [fault] };
}

/** The jobs as they are run; what only the controller knows is left out and told. */
export function executable(opened: Extract<Opened, { kind: "opened" }>): Extract<Interpreted, { kind: "ready" }> {
  const notices = new Notices();
  return {
    kind: "ready",
    run: signals => opened.start(signals, notices).steps,
    context: opened.context,
    notExecuted: notices.faults,
  };
}
