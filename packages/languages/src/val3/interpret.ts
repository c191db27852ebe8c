import type { Executed, Interpreted, Pose, Robot, Signals, TextFault } from "@twincell/core";
import { rehearse, textFault } from "../text/index.ts";
import { changedNames } from "../text/structured/index.ts";
import { readApplication, type Application } from "./read/application.ts";
import { hasWorld } from "./run/arm.ts";
import { Machine, type Surroundings } from "./run/machine.ts";

export interface Loaded { readonly application: Application; readonly machine: (surroundings: Surroundings, signals?: Signals) => Machine }

export function load(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): { readonly kind: "loaded"; readonly loaded: Loaded } | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] } {
  if (!hasWorld(robot)) return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks VAL 3", `The controller of the ${robot.name} does not speak VAL 3.`)] };
  const read = readApplication(text);
  if (read.kind === "not-understood") return read;
  const { application } = read, changing = changedNames([...application.routines.values()].map(({ body }) => body));
  return { kind: "loaded", loaded: { application, machine: (surroundings, signals) => new Machine(application, changing, robot, worldFromBase, surroundings, signals) } };
}

export const newSurroundings = (): Surroundings => ({ tools: {}, frames: {}, signals: {} });

/** Executes the program "start", or the first of the text, with the data that stand behind it. */
export function interpretVal3(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
  const answer = load(text, robot, worldFromBase);
  if (answer.kind === "not-understood") return answer;
  const { machine } = answer.loaded, surroundings = newSurroundings();
  const run = function* (signals?: Signals): Generator<Executed, void> { yield* machine(surroundings, signals).main(); };
  const fault = rehearse(run());
  if (fault !== undefined) return { kind: "not-understood", faults: [fault] };
  return { kind: "ready", run, context: surroundings };
}
