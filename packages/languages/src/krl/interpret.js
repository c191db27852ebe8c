import { rehearse, textFault } from "../text/index.ts";
import { readSource } from "./read/source.ts";
import { Axes } from "./run/axes.ts";
import { Machine } from "./run/machine.ts";
import { ControllerState } from "./run/state.ts";
export function openKrl(text, robot, worldFromBase) {
    const axes = Axes.of(robot);
    if (axes === undefined) {
        return { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, "a robot whose controller speaks KRL", `How KRL counts the axes of the ${robot.name} is not known.`)] };
    }
    const read = readSource(text);
    if (read.kind === "not-understood")
        return read;
    const context = { tools: {}, frames: {}, signals: {} };
    const start = (signals) => {
        const state = new ControllerState(robot, axes, worldFromBase, context), machine = new Machine(read.source, state, signals, context.signals);
        return { steps: machine.run(), assumed: state.system.assumed, warned: state.system.warned };
    };
    return { kind: "opened", source: read.source, context, start };
}
/**
 * Executes KRL text: a .src, with the .dat that belongs to it behind it. Positions count from $BASE, which counts from
 * where the robot stands in the cell.
 */
export function interpretKrl(text, robot, worldFromBase) {
    const opened = openKrl(text, robot, worldFromBase);
    if (opened.kind === "not-understood")
        return opened;
    const fault = rehearse(opened.start().steps);
    if (fault !== undefined)
        return { kind: "not-understood", faults: [fault] };
    return { kind: "ready", run: signals => opened.start(signals).steps, context: opened.context };
}
