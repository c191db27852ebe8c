import { rehearse, textFault } from "../text/index.ts";
import { readSource } from "./read/source.ts";
import { hasPendant } from "./run/arm.ts";
import { Machine } from "./run/machine.ts";
export function load(text, robot, worldFromBase) {
    if (!hasPendant(robot)) {
        return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks FANUC TP", `The controller of the ${robot.name} does not speak FANUC TP.`)] };
    }
    const read = readSource(text);
    if (read.kind === "not-understood")
        return read;
    return { kind: "loaded", loaded: { source: read.source, machine: (surroundings, signals, writesDown = false) => new Machine(read.source, robot, worldFromBase, surroundings, signals, writesDown) } };
}
export const newSurroundings = () => ({ tools: {}, frames: {}, signals: {} });
/** Executes one listing, or several one behind the other of which the first is started. */
export function interpretFanucLs(text, robot, worldFromBase) {
    const answer = load(text, robot, worldFromBase);
    if (answer.kind === "not-understood")
        return answer;
    const { machine } = answer.loaded, surroundings = newSurroundings();
    const run = function* (signals) { yield* machine(surroundings, signals).main(); };
    const fault = rehearse(run());
    if (fault !== undefined)
        return { kind: "not-understood", faults: [fault] };
    return { kind: "ready", run, context: surroundings };
}
