import { capabilitiesUsed } from "@twincell/core";
/** Ends the writing of a program: nothing of it is kept. Caught at the door of the dialect. */
export class CannotSay extends Error {
    answer;
    constructor(step, sentence, hint) {
        super(sentence);
        this.answer = { kind: "cannot", step, sentence, hint };
    }
}
/** A program that is longer than the controller holds: it may be written in parts. */
export class TooLong extends CannotSay {
}
export const called = ({ id, name }) => `Step ${name ?? id}`;
const WORDS = {
    circ: "is a circ move", spline: "is a spline move", duration: "is given a duration", acceleration: "is given an acceleration", search: "is a search move",
    timeout: "waits with a time limit", pulse: "is a pulse",
};
/** The first step that asks for what the dialect declares it cannot. */
export function undeclared(program, cannot) {
    const used = capabilitiesUsed(program);
    for (const { what, because } of cannot) {
        const step = used.get(what);
        if (step !== undefined)
            return { kind: "cannot", step: step.id, sentence: `${called(step)} ${WORDS[what] ?? `asks for ${what}`}. ${because}`, hint: "Say it in another way, or take the step out." };
    }
    return undefined;
}
/** Writes, or says why not. */
export function writtenOr(write) {
    try {
        return write();
    }
    catch (cause) {
        if (!(cause instanceof CannotSay))
            throw cause;
        return cause.answer;
    }
}
export const tellsRobot = (program, robot) => program.robot === robot.id ? [] : [`The program was taught on ${program.robot} and is written for ${robot.id}.`];
