import type { Executed, Interpreted, Pose, Robot, Signals } from "@twincell/core";
import { rehearse, textFault } from "../text/index.ts";
import { changedNames } from "../text/structured/index.ts";
import { readSource, type Source } from "./read/grammar.ts";
import { Machine, type Surroundings } from "./run/machine.ts";

/** Robots whose controllers speak RAPID. Their joint angles are those of the library: none is coupled, turned round or counted from elsewhere. */
const SPEAKS: ReadonlySet<string> = new Set(["abb_irb120", "abb_crb15000_5_95"]);
/** A module that was read, with what its runs have in common. */
export interface Loaded { readonly source: Source; readonly machine: (surroundings: Surroundings, signals?: Signals) => Machine }

export function load(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): { readonly kind: "loaded"; readonly loaded: Loaded } | Extract<Interpreted, { kind: "not-understood" }> {
  if (!SPEAKS.has(robot.id)) {
    return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks RAPID", `The controller of the ${robot.name} does not speak RAPID.`)] };
  }
  const read = readSource(text);
  if (read.kind === "not-understood") return read;
  const { source } = read, changing = changedNames([...source.routines.values()].map(({ body }) => body));
  return { kind: "loaded", loaded: { source, machine: (surroundings, signals) => new Machine(source, changing, robot, worldFromBase, surroundings, signals) } };
}

export const newSurroundings = (): Surroundings => ({ tools: {}, frames: {}, signals: {} });

/** Executes RAPID: PROC main, or the only routine of the text. */
export function interpretRapid(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
  const answer = load(text, robot, worldFromBase);
  if (answer.kind === "not-understood") return answer;
  const { machine } = answer.loaded, surroundings = newSurroundings();
  const run = function* (signals?: Signals): Generator<Executed, void> { yield* machine(surroundings, signals).main(); };
  const fault = rehearse(run());
  if (fault !== undefined) return { kind: "not-understood", faults: [fault] };
  return { kind: "ready", run, context: surroundings };
}
