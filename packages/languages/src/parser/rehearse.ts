import type { Executed, TextFault } from "@twincell/core";
import { TextError } from "./faults.ts";
import { WaitsOutside } from "./waits-outside.ts";

/** Enough to see that a program runs on the spot; one that moves for ever goes on longer. */
const BEFOREHAND = { steps: 5_000, statements: 150_000 } as const;

/**
 * Runs a program beforehand, so that its tools, frames and faults are met before a robot moves.
 *
 * @returns the fault it ran into, or undefined; what hangs on a line from outside shows only when the program runs.
 *   What else is
 *          thrown goes on to the caller.
 */
export function dryRun(run: Iterable<Executed>): TextFault | undefined {
  let steps = 0;
  let statements = 0;
  try {
    for (const { step } of run) {
      if (step !== undefined) steps++;
      if (steps >= BEFOREHAND.steps || ++statements >= BEFOREHAND.statements) break;
    }
    return undefined;
  } catch (cause) {
    if (cause instanceof TextError) return cause.fault;
    if (cause instanceof WaitsOutside) return undefined;
    throw cause;
  }
}
