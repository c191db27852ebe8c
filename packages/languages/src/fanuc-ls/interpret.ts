import type { Executed, Interpreted, Pose, Robot, Signals, TextFault } from "@twincell/core";
import { rehearse, textFault } from "../text/index.ts";
import { readSource, type Source } from "./read/source.ts";
import { hasPendant } from "./run/arm.ts";
import { Machine, type Surroundings } from "./run/machine.ts";

export interface Loaded { readonly source: Source; readonly machine: (surroundings: Surroundings, signals?: Signals, writesDown?: boolean) => Machine }

export function load(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): { readonly kind: "loaded"; readonly loaded: Loaded } | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] } {
  if (!hasPendant(robot)) {
    return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks FANUC TP", `The controller of the ${robot.name} does not speak FANUC TP.`)] };
  }
  const read = readSource(text);
  if (read.kind === "not-understood") return read;
  return { kind: "loaded", loaded: { source: read.source, machine: (surroundings, signals, writesDown = false) => new Machine(read.source, robot, worldFromBase, surroundings, signals, writesDown) } };
}

export const newSurroundings = (): Surroundings => ({ tools: {}, frames: {}, signals: {} });

/** Executes one listing, or several one behind the other of which the first is started. */
export function interpretFanucLs(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
  const answer = load(text, robot, worldFromBase);
  if (answer.kind === "not-understood") return answer;
  const { machine } = answer.loaded, surroundings = newSurroundings();
  const run = function* (signals?: Signals): Generator<Executed, void> { yield* machine(surroundings, signals).main(); };
  const fault = rehearse(run());
  if (fault !== undefined) return { kind: "not-understood", faults: [fault] };
  return { kind: "ready", run, context: surroundings };
}
