import { emptyProgram } from "@twincell/core";
import { TextError } from "../text/index.ts";
import { Outline } from "../text/structured/index.ts";
import { load, newSurroundings } from "./interpret.ts";
/**
 * The neutral program that a text amounts to: loops that do the same each time stay loops, nests of loops over a pattern of
 * places become pallets, decisions by one line and calls stay what they are. Everything else comes out as what it does.
 */
export function parseAs(text, robot, worldFromBase) {
    const answer = load(text, robot, worldFromBase);
    if (answer.kind === "not-understood")
        return answer;
    const { source, machine } = answer.loaded, surroundings = newSurroundings(), outline = new Outline(machine(surroundings));
    try {
        const steps = outline.steps(source.main), { groups, routines, pallets, warnings } = outline, { tools, frames, signals } = surroundings;
        return { kind: "parsed", warnings, program: { ...emptyProgram(robot.id, source.title), tools, frames, groups, signals, pallets, routines, steps } };
    }
    catch (cause) {
        if (!(cause instanceof TextError))
            throw cause;
        return { kind: "not-understood", faults: [cause.fault] };
    }
}
