import type { Executed, Interpreted, Pose, Robot, Signals, TextFault } from "@twincell/core";
import { TextError, textFault } from "../text/index.ts";
import type { Block } from "../text/structured/index.ts";
import { readApplication, type Application } from "./read/application.ts";
import { hasWorld } from "./run/arm.ts";
import { Machine, type Surroundings } from "./run/machine.ts";

/** How far a program is run beforehand to meet its tools, frames and faults; one that moves for ever goes on longer. */
const BEFOREHAND = { steps: 5_000, statements: 150_000 } as const;

export interface Loaded { readonly application: Application; readonly machine: (surroundings: Surroundings, signals?: Signals) => Machine }

export function load(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): { readonly kind: "loaded"; readonly loaded: Loaded } | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] } {
  if (!hasWorld(robot)) return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks VAL 3", `The controller of the ${robot.name} does not speak VAL 3.`)] };
  const read = readApplication(text);
  if (read.kind === "not-understood") return read;
  const { application } = read, changing = new Set<string>();
  for (const { body } of application.routines.values()) noteChanges(body, changing);
  return { kind: "loaded", loaded: { application, machine: (surroundings, signals) => new Machine(application, changing, robot, worldFromBase, surroundings, signals) } };
}

export const newSurroundings = (): Surroundings => ({ tools: {}, frames: {}, signals: {} });

/** Executes the program "start", or the first of the text, with the data that stand behind it. */
export function interpretVal3(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
  const answer = load(text, robot, worldFromBase);
  if (answer.kind === "not-understood") return answer;
  const { machine } = answer.loaded, surroundings = newSurroundings();
  const run = function* (signals?: Signals): Generator<Executed, void> { yield* machine(surroundings, signals).main(); };
  try {
    let steps = 0, statements = 0;
    for (const { step } of run()) {
      if (step !== undefined) steps++;
      if (steps >= BEFOREHAND.steps || ++statements >= BEFOREHAND.statements) break;
    }
  } catch (cause) {
    if (!(cause instanceof TextError)) throw cause;
    return { kind: "not-understood", faults: [cause.fault] };
  }
  return { kind: "ready", run, context: surroundings };
}

/** Names of data that a statement gives a value. */
function noteChanges(block: Block, into: Set<string>): void {
  for (const statement of block) {
    switch (statement.kind) {
      case "assign": {
        const { to } = statement, of = to.kind === "index" ? to.of : to;
        if (of.kind === "variable") into.add(of.name);
        break;
      }
      case "if":
        for (const { body } of statement.branches) noteChanges(body, into);
        if (statement.otherwise !== undefined) noteChanges(statement.otherwise, into);
        break;
      case "while": case "for": noteChanges(statement.body, into); break;
      default: break;
    }
  }
}
