import { emptyProgram } from "@twincell/core";
import { TextError, textFault } from "../text/index.ts";
import { Outline } from "../text/structured/index.ts";
import { load, newSurroundings } from "./interpret.ts";
/** A program with more steps than this is taken to repeat itself for ever. */
const MOST_STEPS = 200_000;
/**
 * The neutral program that listings amount to: loops that do the same each time, pallets of shifted points, decisions by one line
 * and calls stay what they are. A program with other jumps is executed with every input off and comes out as what it does.
 */
export function parseFanucLs(text, robot, worldFromBase) {
    const answer = load(text, robot, worldFromBase);
    if (answer.kind === "not-understood")
        return answer;
    const { source } = answer.loaded, surroundings = newSurroundings(), machine = answer.loaded.machine(surroundings, undefined, true);
    try {
        const outline = new Outline(machine, name => machine.spelt(name)), steps = source.hasJumps ? executed(machine) : outline.steps(machine.open());
        const { groups, routines, pallets } = outline, { tools, frames, signals } = surroundings;
        const warnings = [
            ...outline.warnings, ...[...machine.assumed].map(([name, at]) => textFault(at, `${name.replace(" ", "[")}]=PR[n]`, `${name} is set up nowhere in the text: it is taken to be no different from the ${name.startsWith("UF") ? "world" : "flange"}.`)),
            ...(source.hasJumps ? [textFault(source.main, "loops and decisions", "The program jumps: it was executed with every input off and written out.")] : []),
        ];
        return { kind: "parsed", warnings, program: { ...emptyProgram(robot.id, source.title), tools, frames, groups, signals, pallets, routines, steps } };
    }
    catch (cause) {
        if (!(cause instanceof TextError))
            throw cause;
        return { kind: "not-understood", faults: [cause.fault] };
    }
}
function executed(machine) {
    const steps = [];
    for (const { step, line } of machine.main()) {
        if (step === undefined)
            continue;
        if (steps.length >= MOST_STEPS)
            throw new TextError({ line, column: 1 }, "a program that ends", `The program has more than ${MOST_STEPS} steps: it repeats itself for ever.`);
        steps.push(step);
    }
    return steps;
}
