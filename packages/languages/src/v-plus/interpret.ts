import type { Executed, Interpreted, Pose, Robot, Signals } from "@twincell/core";
import { Notices, ShownAxes, dryRun, strangeRobot, type DeclaredCell } from "../parser/index.ts";
import { readSource } from "./read/source.ts";
import { Machine } from "./run/machine.ts";
import type { DeclaredContext } from "./run/state.ts";

/** A text ready to be executed, and what its steps refer to. */
export type Opened =
  | {
      readonly kind: "opened";
      readonly start: (signals?: Signals) => Generator<Executed, void>;
      readonly declared: DeclaredCell;
      readonly ready: Extract<Interpreted, { kind: "ready" }>;
    }
  | Extract<Interpreted, { kind: "not-understood" }>;

/** @returns a text that was executed once without a fault. */
export function openVPlus(text: string, robot: Robot, worldFromBase: Pose<"world", "base">, notices?: Notices): Opened {
  const axes = ShownAxes.of(robot, "v-plus");
  if (axes === undefined) return strangeRobot(robot, "V+", "joints");
  const read = readSource(text, notices !== undefined);
  if (read.kind === "not-understood") return read;
  const met: DeclaredContext = { tools: {}, lines: {} };
  const start = (signals?: Signals): Generator<Executed, void> =>
    new Machine(read.source, robot, axes, worldFromBase, met, signals, notices).run();
  const fault = dryRun(start());
  if (fault !== undefined) return { kind: "not-understood", faults: [fault] };
  const declared: DeclaredCell = { tools: met.tools, frames: {}, signals: met.lines };
  const notExecuted = notices === undefined ? {} : { notExecuted: notices.faults };
  return { kind: "opened", start, declared, ready: { kind: "ready", run: start, context: declared, ...notExecuted } };
}

/**
 * Executes V+ text: a disk file (its first program) or a list of terminal commands. Locations count from the shoulder
 * of the robot, wherever its base stands in the cell.
 */
export function interpretVPlus(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
  const opened = openVPlus(text, robot, worldFromBase, new Notices());
  return opened.kind === "opened" ? opened.ready : opened;
}

/** The same, where nothing may be left out that only the controller knows: a text that is kept as steps. */
export function interpretWhole(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
  const opened = openVPlus(text, robot, worldFromBase);
  return opened.kind === "opened" ? opened.ready : opened;
}
