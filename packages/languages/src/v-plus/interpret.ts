import type { Executed, Interpreted, Pose, Robot, Signals } from "@twincell/core";
import { ShownAxes, dryRun, textFault } from "../parser/index.ts";
import { readSource } from "./read/source.ts";
import { Machine } from "./run/machine.ts";
import type { DeclaredContext } from "./run/state.ts";

/**
 * Executes V+ text: a disk file (its first program) or a list of terminal commands. Locations count from the shoulder
 * of the robot, wherever its base stands in the cell.
 */
export function interpretVPlus(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Interpreted {
  const axes = ShownAxes.of(robot, "v-plus");
  if (axes === undefined) {
    return {
      kind: "not-understood",
      faults: [
        textFault(
          { line: 1, column: 1 },
          "a robot whose controller speaks V+",
          `How V+ counts the joints of the ${robot.name} is not known.`,
        ),
      ],
    };
  }
  const read = readSource(text);
  if (read.kind === "not-understood") return read;
  const met: DeclaredContext = { tools: {}, lines: {} };
  const run = (signals?: Signals): Generator<Executed, void> =>
    new Machine(read.source, robot, axes, worldFromBase, met, signals).run();
  const fault = dryRun(run());
  if (fault !== undefined) return { kind: "not-understood", faults: [fault] };
  return { kind: "ready", run, context: { tools: met.tools, frames: {}, signals: met.lines } };
}
