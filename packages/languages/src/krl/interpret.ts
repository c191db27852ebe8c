import type { Executed, Interpreted, Pose, Robot, Signals, TextFault, TextPlace } from "@twincell/core";
import { dryRun, textFault, strangeRobot, type DeclaredCell, createDeclaredCell } from "../parser/index.ts";
import { readSource } from "./read/source.ts";
import type { Source } from "./read/syntax.ts";
import { Axes } from "./run/axes.ts";
import { Machine } from "./run/machine.ts";
import { ControllerState } from "./run/state.ts";

/** A module ready to be executed, with what only its reader wants to know. */
export type Opened =
  | {
      readonly kind: "opened";
      readonly source: Source;
      readonly context: DeclaredCell;
      readonly start: (signals?: Signals) => Run;
    }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };
export interface Run {
  readonly steps: Generator<Executed, void>;
  readonly assumed: ReadonlyMap<string, TextPlace>;
  readonly warned: readonly { readonly at: TextPlace; readonly sentence: string }[];
  /** What is not carried out as it stands, by what it is about. */
  readonly notes: ReadonlyMap<string, TextFault>;
}

export function openKrl(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Opened {
  const axes = Axes.of(robot);
  if (axes === undefined) {
    return strangeRobot(robot, "KRL", "axes");
  }
  const read = readSource(text);
  if (read.kind === "not-understood") return read;
  const context: DeclaredCell = createDeclaredCell();
  const start = (signals?: Signals): Run => {
    const state = new ControllerState(robot, axes, worldFromBase, context);
    const machine = new Machine(read.source, state, signals, context.signals);
    return { steps: machine.run(), assumed: state.system.assumed, warned: state.system.warned, notes: machine.notes };
  };
  return { kind: "opened", source: read.source, context, start };
}

/**
 * Executes KRL text: a .src, with the .dat that belongs to it behind it. Positions count from $BASE, which counts from
 * where the robot stands in the cell.
 */
export function interpretKrl(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
  const opened = openKrl(text, robot, worldFromBase);
  if (opened.kind === "not-understood") return opened;
  const rehearsal = opened.start();
  const fault = dryRun(rehearsal.steps);
  if (fault !== undefined) return { kind: "not-understood", faults: [fault] };
  const kept = [...rehearsal.notes.values(), ...assumedFaults(rehearsal.assumed)].toSorted((a, b) => a.line - b.line);
  return {
    kind: "ready",
    run: signals => opened.start(signals).steps,
    context: opened.context,
    ...(kept.length === 0 ? {} : { notExecuted: kept }),
  };
}

/** What was taken as a controller has it on delivery, where it is asked for first. */
export const assumedFaults = (assumed: ReadonlyMap<string, TextPlace>): readonly TextFault[] =>
  [...assumed].map(([name, at]) =>
    textFault(at, "a value in the text", `${name} is kept on the controller: it is taken as it is on delivery.`),
  );
