import { rehearse, textFault } from "../text/index.ts";
import { changedNames } from "../text/structured/index.ts";
import { readApplication } from "./read/application.ts";
import { hasWorld } from "./run/arm.ts";
import { Machine } from "./run/machine.ts";
export function load(text, robot, worldFromBase) {
    if (!hasWorld(robot))
        return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks VAL 3", `The controller of the ${robot.name} does not speak VAL 3.`)] };
    const read = readApplication(text);
    if (read.kind === "not-understood")
        return read;
    const { application } = read, changing = changedNames([...application.routines.values()].map(({ body }) => body));
    return { kind: "loaded", loaded: { application, machine: (surroundings, signals) => new Machine(application, changing, robot, worldFromBase, surroundings, signals) } };
}
export const newSurroundings = () => ({ tools: {}, frames: {}, signals: {} });
/** Executes the program "start", or the first of the text, with the data that stand behind it. */
export function interpretVal3(text, robot, worldFromBase) {
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
