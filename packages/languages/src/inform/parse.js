import { emptyProgram } from "@twincell/core";
import { TextError, WaitsOutside, plainText, textFault, textLines } from "../text/index.ts";
import { openInform } from "./interpret.ts";
/** A job with more steps than this is taken to repeat itself for ever. */
const MOST_STEPS = 200_000;
/**
 * The neutral program that jobs amount to, with TOOL.CND and UFRAME.CND behind them. The first job is executed with every
 * input off and its motions written down, so loops, calls and shifts come out as what they do.
 */
export function parseInform(text, robot, worldFromBase, pulses) {
    const opened = openInform(text, robot, worldFromBase, pulses);
    if (opened.kind === "not-understood")
        return opened;
    const lines = textLines(text).map(plainText), run = opened.start();
    const steps = [], from = [], met = new Set(), repeated = new Set(), warnings = [];
    try {
        for (const { line, step } of run.steps) {
            if (step === undefined)
                continue;
            if (steps.length >= MOST_STEPS)
                return { kind: "not-understood", faults: [textFault({ line, column: 1 }, "a job that ends", `The job has more than ${MOST_STEPS} steps: it repeats itself for ever.`)] };
            if (met.has(line))
                repeated.add(line);
            met.add(line);
            from.push(line);
            steps.push({ ...step, id: `s${steps.length + 1}` });
        }
    }
    catch (cause) {
        if (cause instanceof WaitsOutside)
            warnings.push(textFault({ line: 1, column: 1 }, "a job that goes on by itself", `${cause.message} ${cause.hint}`));
        else if (cause instanceof TextError)
            return { kind: "not-understood", faults: [cause.fault] };
        else
            throw cause;
    }
    for (const [name, at] of run.assumed)
        warnings.push(textFault(at, "TOOL.CND or UFRAME.CND behind the job", `${name} is kept on the controller: it is taken to be 0.`));
    for (const line of repeated)
        warnings.push(textFault({ line, column: 1 }, "an instruction that is executed once", `Line ${line} is executed more than once: every time became a step of its own.`));
    const { tools, frames, signals } = opened.context;
    return { kind: "parsed", warnings, program: { ...emptyProgram(robot.id, nameOf(lines)), ...withComments(lines, steps, from), tools, frames, signals } };
}
/** What a person called the job: its comment, or its name. */
function nameOf(lines) {
    const end = lines.findIndex(line => /^END\b/i.test(line.trim())), head = lines.slice(0, end < 0 ? undefined : end);
    const of = (word) => head.map(line => word.exec(line)?.[1]).find(text => text !== undefined);
    return of(/^\/\/\/COMM\s+(.*\S)/i) ?? of(/^\/\/NAME\s+(\S+)/i) ?? "Job";
}
/** Names and groups from the comments: `'name` before a step, `'== name` before a group of steps, `'* text` for a comment of its own. */
function withComments(lines, steps, from) {
    const stepLines = new Set(from);
    const names = new Map(), groupOf = new Map(), before = new Map();
    const groups = {};
    let name, group, count = 0, said = [];
    for (const [i, line] of lines.entries()) {
        if (/^\/JOB\b/i.test(line)) {
            group = name = undefined;
            said = [];
        }
        const comment = /^\s*'(.*)/.exec(line)?.[1]?.trim();
        if (comment?.startsWith("==") === true) {
            const title = comment.replace(/^=+\s*/, "");
            group = title === "" ? undefined : `g${++count}`;
            if (group !== undefined)
                groups[group] = { name: title };
        }
        else if (comment?.startsWith("*") === true)
            said.push(comment.slice(1).trim());
        else if (comment !== undefined && comment !== "")
            name = comment;
        if (!stepLines.has(i + 1))
            continue;
        if (name !== undefined)
            names.set(i + 1, name);
        if (group !== undefined)
            groupOf.set(i + 1, group);
        if (said.length > 0)
            before.set(i + 1, said);
        name = undefined;
        said = [];
    }
    const list = [];
    for (const [i, step] of steps.entries()) {
        const line = from[i], called = names.get(line), member = groupOf.get(line), texts = before.get(line) ?? [];
        before.delete(line);
        for (const [k, text] of texts.entries())
            list.push({ id: `${step.id}.${k + 1}`, type: "comment", text, ...(member === undefined ? {} : { group: member }) });
        list.push({ ...step, ...(called === undefined ? {} : { name: called }), ...(member === undefined ? {} : { group: member }) });
    }
    return { groups, steps: list };
}
