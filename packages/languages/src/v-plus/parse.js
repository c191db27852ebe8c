import { emptyProgram } from "@twincell/core";
import { TextError, plainText, textFault, textLines } from "../text/index.ts";
import { interpretVPlus } from "./interpret.ts";
import { structuredProgram } from "./read/structure.ts";
/** A program with more steps than this is taken to repeat itself for ever. */
const MOST_STEPS = 20_000;
/** Share of the full speed at which the points of a point list are passed; the list says nothing about it. */
const POINT_LIST_RATIO = 0.2;
const POINT = /^\s*(?:DO\s+)?DECOMPOSE\s+([A-Z][A-Z0-9_.]*)\s*\[\s*([0-9]+)\s*\]\s*=\s*#PPOINT\s*\(/i;
/**
 * The neutral program that a V+ text amounts to. Loops, calls, decisions and pallets that a neutral program has too are
 * kept. Any other text is executed and its motions written down, so its loops and arrays come out as what they do. A point list moves nothing: each of its points becomes a joint move.
 */
export function parseVPlus(text, robot, worldFromBase) {
    const lines = textLines(text).map(plainText);
    const isList = lines.some(line => POINT.test(line)) && !lines.some(line => /^\s*\.PROGRAM\b/i.test(line));
    const structured = isList ? undefined : structuredProgram(text, lines, robot, worldFromBase, nameOf(lines));
    if (structured?.kind === "program")
        return { kind: "parsed", program: structured.program, warnings: [] };
    if (structured?.kind === "not-understood")
        return structured;
    const source = isList ? lines.map(asMove).join("\n") : text;
    const interpreted = interpretVPlus(source, robot, worldFromBase);
    if (interpreted.kind === "not-understood")
        return interpreted;
    const steps = [], from = [], met = new Set(), repeated = new Set();
    try {
        const run = interpreted.run();
        for (let next = run.next(); next.done !== true; next = run.next()) {
            const { line, step } = next.value;
            if (step === undefined)
                continue;
            if (steps.length >= MOST_STEPS)
                return { kind: "not-understood", faults: [textFault({ line, column: 1 }, "a program that ends", `The program has more than ${MOST_STEPS} steps: it repeats itself for ever.`)] };
            if (met.has(line))
                repeated.add(line);
            met.add(line);
            from.push(line);
            const id = `s${steps.length + 1}`;
            steps.push(isList && step.type === "move" ? { ...step, id, speed: { ratio: POINT_LIST_RATIO } } : { ...step, id });
        }
    }
    catch (cause) {
        if (!(cause instanceof TextError))
            throw cause;
        return { kind: "not-understood", faults: [cause.fault] };
    }
    const named = withComments(lines, steps, from);
    const warnings = [];
    if (isList)
        warnings.push(textFault({ line: 1, column: 1 }, "a program with MOVE", "A point list fills an array and moves nothing: each of its points became a joint move."));
    for (const line of repeated)
        warnings.push(textFault({ line, column: 1 }, "a statement that is executed once", `Line ${line} is executed more than once: every time became a step of its own.`));
    return { kind: "parsed", warnings, program: { ...emptyProgram(robot.id, nameOf(lines)), ...named, tools: interpreted.context.tools, signals: interpreted.context.signals ?? {} } };
}
/** The line of a point list as the move to its point, every character of the point in its column. Other lines stay as they are. */
const asMove = (line) => POINT.test(line) ? "MOVE".padEnd(line.indexOf("#")) + line.slice(line.indexOf("#")) : line;
/** What a person called the program: the comment behind its name, or its name. */
function nameOf(lines) {
    const header = lines.find(line => /^\s*\.PROGRAM\b/i.test(line));
    if (header === undefined)
        return "Point list";
    const comment = /;(.*)/.exec(header)?.[1]?.trim() ?? "";
    return comment !== "" ? comment : /\.PROGRAM\s+([^\s(;]+)/i.exec(header)?.[1] ?? "Program";
}
/** Names and groups from the comments: `;name` before a step, `;== name` before a group of steps, `;*` for neither. */
function withComments(lines, steps, from) {
    const stepLines = new Set(from);
    const names = new Map(), groupOf = new Map();
    const groups = {};
    let name, group, count = 0;
    for (const [i, line] of lines.entries()) {
        const comment = /^\s*;(.*)/.exec(line)?.[1]?.trim();
        if (comment?.startsWith("==") === true) {
            const title = comment.replace(/^=+\s*/, "");
            group = title === "" ? undefined : `g${++count}`;
            if (group !== undefined)
                groups[group] = { name: title };
        }
        else if (comment !== undefined && comment !== "" && !comment.startsWith("*"))
            name = comment;
        if (!stepLines.has(i + 1))
            continue;
        if (name !== undefined)
            names.set(i + 1, name);
        if (group !== undefined)
            groupOf.set(i + 1, group);
        name = undefined;
    }
    return {
        groups,
        steps: steps.map((step, i) => {
            const called = names.get(from[i]), member = groupOf.get(from[i]);
            return { ...step, ...(called === undefined ? {} : { name: called }), ...(member === undefined ? {} : { group: member }) };
        }),
    };
}
