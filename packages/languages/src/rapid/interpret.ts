import type { Executed, Interpreted, Pose, Robot, Signals } from "@twincell/core";
import { TextError, textFault } from "../text/index.ts";
import type { Block } from "../text/structured/index.ts";
import { readSource, type Source } from "./read/grammar.ts";
import { Machine, type Surroundings } from "./run/machine.ts";

/** Robots whose controllers speak RAPID. Their joint angles are those of the library: none is coupled, turned round or counted from elsewhere. */
const SPEAKS: ReadonlySet<string> = new Set(["abb_irb120", "abb_crb15000_5_95"]);
/**
 * How far a program is run beforehand to meet its tools, frames and faults: enough to see that it runs on the spot.
 * A program that moves for ever goes on longer.
 */
const BEFOREHAND = { steps: 5_000, statements: 150_000 } as const;

/** A module that was read, with what its runs have in common. */
export interface Loaded { readonly source: Source; readonly machine: (surroundings: Surroundings, signals?: Signals) => Machine }

export function load(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): { readonly kind: "loaded"; readonly loaded: Loaded } | Extract<Interpreted, { kind: "not-understood" }> {
  if (!SPEAKS.has(robot.id)) {
    return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks RAPID", `The controller of the ${robot.name} does not speak RAPID.`)] };
  }
  const read = readSource(text);
  if (read.kind === "not-understood") return read;
  const { source } = read, changing = new Set<string>();
  for (const { body } of source.routines.values()) noteChanges(body, changing);
  return { kind: "loaded", loaded: { source, machine: (surroundings, signals) => new Machine(source, changing, robot, worldFromBase, surroundings, signals) } };
}

export const newSurroundings = (): Surroundings => ({ tools: {}, frames: {}, signals: {} });

/** Executes RAPID: PROC main, or the only routine of the text. */
export function interpretRapid(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
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

/** Names of data that are given a value by a statement. */
function noteChanges(block: Block, into: Set<string>): void {
  for (const statement of block) {
    switch (statement.kind) {
      case "assign": {
        let { to } = statement;
        while (to.kind === "component" || to.kind === "index") to = to.of;
        if (to.kind === "variable") into.add(to.name);
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
