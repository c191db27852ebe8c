import type { Executed, Interpreted, Pose, Robot, Signals } from "@twincell/core";
import { TextError, textFault } from "../text/index.ts";
import { readSource } from "./read/source.ts";
import { jointConvention } from "./robots.ts";
import { Machine } from "./run/machine.ts";
import type { Met } from "./run/state.ts";

/**
 * How far a program is run beforehand to meet its tools and its faults: enough to see that it runs on the spot.
 * A program that moves for ever goes on longer.
 */
const BEFOREHAND = { steps: 5_000, statements: 150_000 } as const;

/**
 * Executes V+ text: a disk file (its first program) or a list of terminal commands. Locations count from the shoulder of
 * the robot, wherever its base stands in the cell.
 */
export function interpretVPlus(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
  const convention = jointConvention(robot);
  if (convention === undefined) {
    return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks V+", `How V+ counts the joints of the ${robot.name} is not known.`)] };
  }
  const read = readSource(text);
  if (read.kind === "not-understood") return read;
  const met: Met = { tools: {}, lines: {} };
  const run = (signals?: Signals): Generator<Executed, void> => new Machine(read.source, robot, convention, worldFromBase, met, signals).run();
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
  return { kind: "ready", run, context: { tools: met.tools, frames: {}, signals: met.lines } };
}
