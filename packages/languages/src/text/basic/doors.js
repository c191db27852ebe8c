import { emptyProgram, identity } from "@twincell/core";
import { TextError, textFault } from "../faults.ts";
import { rehearse } from "../rehearse.ts";
import { Outline } from "../structured/index.ts";
const surroundings = () => ({ tools: {}, frames: {}, signals: {} });
/** The two doors through which text comes in. */
export function basicDoors({ name, speaks, read, machine }) {
    const load = (text, robot) => speaks(robot) ? read(text) : { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, `a robot whose controller speaks ${name}`, `The controller of the ${robot.name} does not speak ${name}.`)] };
    return {
        interpret: (text, robot, worldFromBase = identity()) => {
            const answer = load(text, robot);
            if (answer.kind === "not-understood")
                return answer;
            const { source } = answer, around = surroundings();
            const run = function* (signals) {
                yield* machine({ source, robot, worldFromBase, surroundings: around, ...(signals === undefined ? {} : { signals }) }).block(source.main);
            };
            const fault = rehearse(run());
            return fault === undefined ? { kind: "ready", run, context: around } : { kind: "not-understood", faults: [fault] };
        },
        parse: (text, robot, worldFromBase = identity()) => {
            const answer = load(text, robot);
            if (answer.kind === "not-understood")
                return answer;
            const around = surroundings();
            try {
                const { title, main } = answer.source, outline = new Outline(machine({ source: answer.source, robot, worldFromBase, surroundings: around })), steps = outline.steps(main);
                const { groups, routines, pallets, warnings } = outline;
                return { kind: "parsed", warnings, program: { ...emptyProgram(robot.id, title), ...around, groups, pallets, routines, steps } };
            }
            catch (cause) {
                if (!(cause instanceof TextError))
                    throw cause;
                return { kind: "not-understood", faults: [cause.fault] };
            }
        },
    };
}
