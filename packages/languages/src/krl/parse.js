import { emptyProgram } from "@twincell/core";
import { TextError, WaitsOutside, plainText, textFault, textLines } from "../text/index.ts";
import { openKrl } from "./interpret.ts";
/** A program with more steps than this is taken to repeat itself for ever. */
const MOST_STEPS = 200_000;
/**
 * The neutral program that a KRL text amounts to: a .src, with its .dat behind it. It is executed with every input off and
 * its motions written down, so loops, calls and pallets come out as what they do.
 */
export function parseKrl(text, robot, worldFromBase) {
    const opened = openKrl(text, robot, worldFromBase);
    if (opened.kind === "not-understood")
        return opened;
    const lines = textLines(text).map(plainText), run = opened.start();
    const steps = [], from = [], met = new Set(), repeated = new Set(), warnings = [];
    try {
        for (const { line, step } of run.steps) {
            if (step === undefined)
                continue;
            if (steps.length >= MOST_STEPS)
                return endless(line, steps.length);
            if (met.has(line))
                repeated.add(line);
            met.add(line);
            from.push(line);
            steps.push({ ...step, id: `s${steps.length + 1}` });
        }
    }
    catch (cause) {
        if (cause instanceof WaitsOutside)
            warnings.push(textFault({ line: 1, column: 1 }, "a program that goes on by itself", `${cause.message} ${cause.hint}`));
        else if (cause instanceof TextError)
            return { kind: "not-understood", faults: [cause.fault] };
        else
            throw cause;
    }
    for (const [name, at] of run.assumed)
        warnings.push(textFault(at, "a value in the text", `${name} is kept on the controller: it is taken as it is on delivery.`));
    for (const { at, sentence } of run.warned)
        warnings.push(textFault(at, "an axis from 1 to 6", sentence));
    for (const line of repeated)
        warnings.push(textFault({ line, column: 1 }, "a statement that is executed once", `Line ${line} is executed more than once: every time became a step of its own.`));
    const { tools, frames, signals } = opened.context;
    return { kind: "parsed", warnings, program: { ...emptyProgram(robot.id, nameOf(lines)), ...withComments(lines, steps, from), tools, frames, signals } };
}
const endless = (line, count) => ({ kind: "not-understood", faults: [textFault({ line, column: 1 }, "a program that ends", `The program has more than ${count} steps: it repeats itself for ever.`)] });
/** What a person called the program: its &COMMENT, or the name of its first routine. */
function nameOf(lines) {
    const comment = lines.map(line => /^\s*&\s*COMMENT\s+(.*\S)/i.exec(line)?.[1]).find(text => text !== undefined);
    return comment ?? lines.map(line => /^\s*(?:GLOBAL\s+)?DEF\s+([^\s(;]+)/i.exec(line)?.[1]).find(text => text !== undefined) ?? "Program";
}
/** Folds that the editor of the controller makes by itself. */
const OWN_FOLD = /^(?:INI|BASISTECH|USER|EXTERNAL|MODULE)\b|;%\{/i;
/** Names and groups from the comments: `;name` before a step, `;FOLD name` around a group of steps, `;* text` for a comment of its own. */
function withComments(lines, steps, from) {
    const stepLines = new Set(from);
    const names = new Map(), groupOf = new Map(), before = new Map();
    const groups = {};
    let name, count = 0, said = [];
    const open = [];
    for (const [i, line] of lines.entries()) {
        const comment = /^\s*;(.*)/.exec(line)?.[1]?.trim();
        if (comment !== undefined) {
            const fold = /^FOLD\b\s*(.*)/i.exec(comment)?.[1];
            if (fold !== undefined) {
                const isGroup = fold !== "" && !OWN_FOLD.test(fold);
                open.push(isGroup ? `g${++count}` : undefined);
                if (isGroup)
                    groups[`g${count}`] = { name: fold };
            }
            else if (/^ENDFOLD\b/i.test(comment))
                open.pop();
            else if (comment.startsWith("*"))
                said.push(comment.slice(1).trim());
            else if (comment !== "")
                name = comment;
        }
        if (!stepLines.has(i + 1))
            continue;
        const group = open.findLast(each => each !== undefined);
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
    const used = new Set(groupOf.values());
    return { groups: Object.fromEntries(Object.entries(groups).filter(([id]) => used.has(id))), steps: list };
}
