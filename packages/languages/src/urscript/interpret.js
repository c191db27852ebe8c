import { rehearse, textFault } from "../text/index.ts";
import { constantsOf } from "../text/structured/index.ts";
import { readSource } from "./read/grammar.ts";
import { Machine, speaksUrScript } from "./run/machine.ts";
export function load(text, robot, worldFromBase) {
    if (!speaksUrScript(robot)) {
        return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks URScript", `The controller of the ${robot.name} does not speak URScript.`)] };
    }
    const read = readSource(text);
    if (read.kind === "not-understood")
        return read;
    const { source } = read, constants = constantsOf(source.main, source.routines.values());
    return { kind: "loaded", loaded: { source, machine: (surroundings, signals) => new Machine(source, constants, robot, worldFromBase, surroundings, signals) } };
}
export const newSurroundings = () => ({ tools: {}, frames: {}, signals: {} });
/** Executes URScript: one program `def … end` with the routines inside it, or the statements of a bare script. */
export function interpretUrScript(text, robot, worldFromBase) {
    const answer = load(text, robot, worldFromBase);
    if (answer.kind === "not-understood")
        return answer;
    const { source, machine } = answer.loaded, surroundings = newSurroundings();
    const run = function* (signals) { yield* machine(surroundings, signals).block(source.main); };
    const fault = rehearse(run());
    if (fault !== undefined)
        return { kind: "not-understood", faults: [fault] };
    return { kind: "ready", run, context: surroundings };
}
