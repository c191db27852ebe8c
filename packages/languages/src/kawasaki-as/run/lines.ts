import type { Condition, SignalLine, Signals, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";

/** Lines that a program speaks of, by their names in the neutral program. */
export type Lines = Record<string, SignalLine>;

/**
 * Outputs count from 1, inputs from 1001, and lines inside the controller, which a program writes and reads, from 2001.
 */
const LAST = 960;
const FIRST_INPUT = 1001;
const LAST_INPUT = 1960;
const FIRST_INNER = 2001;
const LAST_INNER = 2960;

/** The line of that number, under the name of the variable that holds the number, else DO3 and its like. */
export function lineAt(number: number, named: string | undefined, lines: Lines, at: TextPlace): string {
  const isInput = number >= FIRST_INPUT && number <= LAST_INPUT;
  const isOutput = (number >= 1 && number <= LAST) || (number >= FIRST_INNER && number <= LAST_INNER);
  if (!Number.isInteger(number) || !(isInput || isOutput))
    throw new TextError(
      at,
      "an output from 1, an input from 1001 or an internal line from 2001",
      `There is no line ${number}.`,
    );
  const kind = isInput ? "digital-in" : "digital-out";
  const known = Object.entries(lines).find(([, line]) => line.address === number);
  if (known !== undefined) return known[0];
  const free = named !== undefined && !Object.hasOwn(lines, named) ? named : `${isInput ? "DI" : "DO"}${number}`;
  lines[free] = { kind, address: number };
  return free;
}

/** Whether a condition of one digital line holds. */
export const holds = (when: Condition, signals: Pick<Signals, "read">): boolean =>
  "is" in when && (signals.read(when.signal) === true) === when.is;
