import { TextError } from "../../text/index.ts";
/** Outputs count from 1, inputs from 1001, and lines inside the controller, which a program writes and reads, from 2001. */
const LAST = 960, FIRST_INPUT = 1001, LAST_INPUT = 1960, FIRST_INNER = 2001, LAST_INNER = 2960;
/** The line of that number, under the name of the variable that holds the number, else DO3 and its like. */
export function lineAt(number, named, lines, at) {
    const isInput = number >= FIRST_INPUT && number <= LAST_INPUT, isOutput = (number >= 1 && number <= LAST) || (number >= FIRST_INNER && number <= LAST_INNER);
    if (!Number.isInteger(number) || !(isInput || isOutput))
        throw new TextError(at, "an output from 1, an input from 1001 or an internal line from 2001", `There is no line ${number}.`);
    const kind = isInput ? "digital-in" : "digital-out", known = Object.entries(lines).find(([, line]) => line.address === number);
    if (known !== undefined)
        return known[0];
    const free = named !== undefined && !Object.hasOwn(lines, named) ? named : `${isInput ? "DI" : "DO"}${number}`;
    lines[free] = { kind, address: number };
    return free;
}
/** Whether a condition of one digital line holds. */
export const holds = (when, signals) => "is" in when && (signals.read(when.signal) === true) === when.is;
