import { rehearse, textFault } from "../text/index.ts";
import { changedNames } from "../text/structured/index.ts";
import { readSource } from "./read/grammar.ts";
import { Machine } from "./run/machine.ts";
/** Robots whose controllers speak RAPID. Their joint angles are those of the library: none is coupled, turned round or counted from elsewhere. */
const SPEAKS = new Set(["abb_irb120", "abb_crb15000_5_95"]);
export function load(text, robot, worldFromBase) {
    if (!SPEAKS.has(robot.id)) {
        return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks RAPID", `The controller of the ${robot.name} does not speak RAPID.`)] };
    }
    const read = readSource(text);
    if (read.kind === "not-understood")
        return read;
    const { source } = read, changing = changedNames([...source.routines.values()].map(({ body }) => body));
    return { kind: "loaded", loaded: { source, machine: (surroundings, signals) => new Machine(source, changing, robot, worldFromBase, surroundings, signals) } };
}
export const newSurroundings = () => ({ tools: {}, frames: {}, signals: {} });
/** Executes RAPID: PROC main, or the only routine of the text. */
export function interpretRapid(text, robot, worldFromBase) {
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
