import { rehearse, textFault } from "../text/index.ts";
import { readSource } from "./read/source.ts";
import { Arm } from "./run/arm.ts";
import { Machine } from "./run/machine.ts";
import { ControllerState } from "./run/state.ts";
export function openInform(text, robot, worldFromBase, pulses) {
    const arm = Arm.of(robot);
    if (arm === undefined) {
        return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks INFORM", `How INFORM counts the axes of the ${robot.name} is not known.`)] };
    }
    const read = readSource(text);
    if (read.kind === "not-understood")
        return read;
    const context = { tools: {}, frames: {}, signals: {} };
    const start = (signals) => {
        const state = new ControllerState(robot, arm, read.source, worldFromBase, context, pulses?.pulsesPerDegree), machine = new Machine(read.source, state, signals, context.signals);
        return { steps: machine.run(), assumed: state.assumed };
    };
    return { kind: "opened", context, start };
}
/** Executes INFORM jobs, the first one of the text, with tools and user frames where the text has them. */
export function interpretInform(text, robot, worldFromBase, pulses) {
    const opened = openInform(text, robot, worldFromBase, pulses);
    if (opened.kind === "not-understood")
        return opened;
    const fault = rehearse(opened.start().steps);
    if (fault !== undefined)
        return { kind: "not-understood", faults: [fault] };
    return { kind: "ready", run: signals => opened.start(signals).steps, context: opened.context };
}
