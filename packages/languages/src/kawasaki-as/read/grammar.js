import { TextError } from "../../text/index.ts";
import { TokenCursor, readExpression } from "../../text/structured/index.ts";
import { INSTRUCTIONS, MOTIONS, SHORT, SPEED_UNITS, UNSAYABLE } from "./words.ts";
const LEXICON = {
    comment: ";", quotes: "\"", doubled: false, lineEnds: true,
    signs: ["==", "<>", "<=", ">=", "=<", "=>", "(", ")", "[", "]", ",", ":", "=", "<", ">", "+", "-", "*", "/", "^", "#", "@", "?", "&", "!"],
    word: /[#$.]*[A-Za-z_][A-Za-z0-9_.]*/y,
};
const RESERVED = new Set([
    "and", "or", "not", "xor", "mod", "if", "then", "else", "elseif", "end", "while", "do", "until", "for", "to", "step", "case", "of", "value", "any", "by",
    "goto", "call", "return", "point", ".program", ".end", ".trans", ".joints", ".reals", ".strings",
]);
const RULES = {
    binary: { or: 1, xor: 1, and: 2, "==": 4, "<>": 4, "<": 4, ">": 4, "<=": 4, ">=": 4, "=<": 4, "=>": 4, "+": 5, "-": 5, "*": 6, "/": 6, mod: 6, "^": 8 },
    prefix: { not: 3, "-": 7, "+": 7, "#": 9 },
    constants: { true: true, on: true, false: false, off: false },
    tags: [], index: "[", components: false, reserved: RESERVED, args: readArguments,
};
/** Deepest nesting of blocks: more than anybody writes, less than the stack holds. */
const DEPTH = 50;
const MOST_FAULTS = 50;
/** Reads AS. Names are lower case. Goes on after a fault, so that all of them are told at once. */
export const readSource = (text) => new Reader(text).source();
class Reader {
    cursor;
    faults = [];
    routines = new Map();
    called = new Set();
    lists = [];
    words = new Map();
    depth = 0;
    constructor(text) { this.cursor = new TokenCursor(text.replace(/^\uFEFF/, ""), LEXICON, word => this.folded(word)); }
    /** Capitals count for nothing. The words of a long text are few. */
    folded(word) {
        const known = this.words.get(word);
        if (known !== undefined)
            return known;
        const small = word.toLowerCase();
        this.words.set(word, small);
        return small;
    }
    source() {
        const { cursor, routines } = this;
        this.guard(() => { cursor.advance(); });
        while (!cursor.done && this.faults.length < MOST_FAULTS) {
            if (cursor.isAt("line-end")) {
                this.guard(() => { cursor.advance(); });
                continue;
            }
            this.guard(() => { this.part(); });
        }
        const first = [...routines.values()].find(({ name }) => !this.called.has(name)) ?? [...routines.values()][0];
        if (first === undefined && this.faults.length === 0)
            this.faults.push(new TextError(cursor.here, ".PROGRAM", "The text holds no program.").fault);
        if (this.faults.length > 0 || first === undefined)
            return { kind: "not-understood", faults: this.faults };
        routines.delete(`call ${first.name}`);
        return { kind: "source", source: { title: titleOf(first.body) ?? first.name, routines, main: [...this.lists, ...first.body] } };
    }
    guard(read) {
        const { depth } = this;
        try {
            return read();
        }
        catch (cause) {
            if (!(cause instanceof TextError))
                throw cause;
            this.faults.push(cause.fault);
            this.depth = depth;
            this.restOfLine();
            return undefined;
        }
    }
    restOfLine() { this.cursor.skip(cursor => cursor.isAt("line-end") || cursor.next === ".end"); }
    /** `.PROGRAM … .END`, `.TRANS … .END` and their like. What else a file of a controller holds means nothing here. */
    part() {
        const { cursor } = this, at = cursor.here, word = cursor.next;
        if (cursor.kind !== "word" || !word.startsWith("."))
            throw cursor.unexpected(".PROGRAM");
        cursor.advance();
        switch (word) {
            case ".program":
                this.program(at);
                return;
            case ".trans":
            case ".joints":
                this.list(word, at);
                return;
            case ".reals":
                this.reals(at);
                return;
            case ".end": throw new TextError(at, ".PROGRAM", "\".END\" stands where nothing is open.");
            default:
                while (!(cursor.kind === "word" && cursor.next === ".end")) {
                    if (cursor.done)
                        throw new TextError(cursor.here, ".END", `The ${word.toUpperCase()} of line ${at.line} is not closed.`);
                    this.restOfLine();
                    while (cursor.isAt("line-end")) {
                        try {
                            cursor.advance();
                        }
                        catch (cause) {
                            if (!(cause instanceof TextError))
                                throw cause;
                            break;
                        }
                    }
                }
                cursor.advance();
        }
    }
    program(at) {
        const { cursor } = this, place = cursor.here, name = cursor.name("the name of the program"), parameters = [];
        if (RESERVED.has(name))
            throw new TextError(place, "a name that is no word of the language", `"${name}" is a word of AS.`);
        if (cursor.accept("(")) {
            while (!cursor.accept(")")) {
                cursor.accept("&");
                parameters.push({ name: cursor.name("the name of a parameter"), type: "", optional: true });
                if (cursor.accept("["))
                    cursor.expect("]");
                if (!cursor.accept(",") && cursor.next !== ")")
                    throw cursor.unexpected("\",\" or \")\"");
            }
        }
        // Behind the name the controller keeps the date of the last change.
        if (cursor.next === "@" || cursor.next === "#")
            this.restOfLine();
        if (!cursor.isAt("line-end"))
            throw cursor.unexpected("the end of the line");
        if (this.routines.has(`call ${name}`))
            this.faults.push(new TextError(place, "a name used once", `The program ${name} is there twice.`).fault);
        const body = this.body("program", at, [".end"]);
        cursor.expect(".end");
        this.routines.set(`call ${name}`, { name, parameters, body, ...place });
    }
    /** `name x y z o a t` or `#name jt1 … jt6`, one a line. */
    list(kind, at) {
        this.entries(kind, at, (to, place, numbers) => {
            const call = { kind: "call", name: kind === ".trans" ? "trans" : "#ppoint", args: numbers.map(value => ({ value, line: value.line, column: value.column })), ...place };
            this.lists.push({ kind: "assign", to, value: call, global: true, ...place });
        });
    }
    reals(at) {
        this.entries(".reals", at, (to, place, numbers) => {
            if (numbers.length !== 1)
                throw new TextError(place, "one number", `${numbers.length} numbers stand where one is expected.`);
            this.lists.push({ kind: "assign", to, value: numbers[0], global: true, ...place });
        });
    }
    entries(kind, at, add) {
        const { cursor } = this;
        for (;;) {
            while (cursor.isAt("line-end"))
                cursor.advance();
            if (cursor.done)
                throw new TextError(cursor.here, ".END", `The ${kind.toUpperCase()} of line ${at.line} is not closed.`);
            if (cursor.accept(".end"))
                return;
            this.guard(() => {
                const place = cursor.here, to = readExpression(cursor, RULES, 0, 100), numbers = [];
                cursor.accept("=");
                while (!cursor.isAt("line-end") && !cursor.done) {
                    numbers.push(readExpression(cursor, RULES, 0, 6));
                    cursor.accept(",");
                }
                add(to, place, numbers);
            });
            if (this.faults.length >= MOST_FAULTS)
                return;
        }
    }
    body(opened, at, ends) {
        const { cursor } = this, statements = [];
        if (++this.depth > DEPTH)
            throw new TextError(at, "a simpler program", `Blocks are nested more than ${DEPTH} deep.`);
        const comments = () => { for (let comment = cursor.comment(); comment !== undefined; comment = cursor.comment())
            statements.push({ kind: "comment", ...comment }); };
        for (;;) {
            if (cursor.isAt("line-end")) {
                this.guard(() => { cursor.advance(); });
                continue;
            }
            comments();
            if (cursor.kind === "word" && ends.includes(cursor.next))
                break;
            if (cursor.done || cursor.next === ".program" || cursor.next === ".end")
                throw new TextError(cursor.here, ends[0].toUpperCase(), `The ${opened} of line ${at.line} is not closed.`);
            if (this.faults.length >= MOST_FAULTS)
                break;
            const statement = this.guard(() => {
                const read = this.statement();
                if (!cursor.isAt("line-end") && !cursor.done)
                    throw cursor.unexpected("the end of the line");
                return read;
            });
            if (statement !== undefined)
                statements.push(statement);
        }
        this.depth--;
        return withBreaks(statements);
    }
    statement() {
        const { cursor } = this;
        // The number of a step, which only GOTO speaks of.
        if (cursor.isAt("number"))
            cursor.advance();
        if (cursor.isAt("line-end"))
            return undefined;
        const at = cursor.here, word = cursor.next;
        if (cursor.kind !== "word")
            throw cursor.unexpected("a statement");
        switch (word) {
            case "if":
                cursor.advance();
                return this.branches(at);
            case "while": {
                cursor.advance();
                const when = readExpression(cursor, RULES);
                cursor.accept("do");
                const body = this.body("WHILE", at, ["end"]);
                cursor.expect("end");
                return { kind: "while", when, body, ...at };
            }
            case "do":
                cursor.advance();
                return this.untilLoop(at);
            case "for":
                cursor.advance();
                return this.counting(at);
            case "case":
                cursor.advance();
                return this.choice(at);
            case "call": {
                cursor.advance();
                const place = cursor.here, name = cursor.name("the name of a program");
                this.called.add(name);
                const args = cursor.accept("(") ? readArguments(cursor, 0) : [];
                return { kind: "do", name: `call ${name}`, args, ...place };
            }
            case "return":
                cursor.advance();
                return { kind: "return", ...at };
            case "halt":
            case "stop":
                cursor.advance();
                return { kind: "halt", ...at };
            case "point":
                cursor.advance();
                return this.assignment(at);
            case "swait": {
                cursor.advance();
                let when;
                do {
                    const value = readExpression(cursor, RULES), one = { kind: "call", name: "sig", args: [{ value, ...at }], ...at };
                    when = when === undefined ? one : { kind: "binary", sign: "and", left: when, right: one, ...at };
                } while (cursor.accept(","));
                return { kind: "wait-until", when, ...at };
            }
            default: break;
        }
        if (Object.hasOwn(UNSAYABLE, word))
            throw new TextError(at, "a statement of the motion program", UNSAYABLE[word]);
        if (RESERVED.has(word))
            throw cursor.unexpected("a statement");
        const { second } = cursor;
        if (second === "=" || (second === "[" && !INSTRUCTIONS.has(word)))
            return this.assignment(at);
        if (second === ":") {
            cursor.advance();
            cursor.advance();
            return undefined;
        }
        if (second === "on" || second === "off")
            return this.switched(at);
        if (!INSTRUCTIONS.has(word))
            throw new TextError(at, "a statement of AS", `"${cursor.raw}" is no statement of AS that is understood here.`);
        return this.instruction(at);
    }
    /** `CP OFF` */
    switched(at) {
        const { cursor } = this, place = cursor.here, name = cursor.take(), value = { kind: "truth", value: cursor.take() === "on", ...place };
        return { kind: "do", name: "switch", args: [{ value: { kind: "text", value: name, ...place }, ...place }, { value, ...place }], ...at };
    }
    instruction(at) {
        const { cursor } = this, word = cursor.take(), name = SHORT[word] ?? word, args = [];
        const mark = (mark, value, place) => { args.push({ name: mark, value: { kind: "text", value, ...place }, ...place }); };
        if (name === "print" || name === "type") {
            // A number and a colon choose the window.
            if (cursor.second === ":") {
                cursor.advance();
                cursor.advance();
            }
        }
        while (!cursor.isAt("line-end") && !cursor.done) {
            const place = cursor.here;
            if (cursor.next === "/" && name === "print") {
                cursor.advance();
                cursor.advance();
                cursor.accept(",");
                continue;
            }
            args.push({ value: isLeftOut(cursor) ? { kind: "number", value: 0, ...place } : readExpression(cursor, RULES), ...place });
            if (name === "decompose" && cursor.accept("="))
                continue;
            if (cursor.accept(",")) {
                if (cursor.isAt("line-end"))
                    throw cursor.unexpected("a value");
                continue;
            }
            if (name === "speed")
                this.unit(mark);
            for (const said of ["always", "fine"])
                if (cursor.next === said && cursor.kind === "word") {
                    mark(said, said, cursor.here);
                    cursor.advance();
                }
            break;
        }
        return { kind: "do", name, args, ...at };
    }
    /** `MM/S`, `MM/MIN`, `S` behind a speed. */
    unit(mark) {
        const { cursor } = this, place = cursor.here;
        if (cursor.kind !== "word" || cursor.next === "always")
            return;
        let unit = cursor.take();
        if (cursor.accept("/"))
            unit += `/${cursor.name("a unit of time")}`;
        if (!Object.hasOwn(SPEED_UNITS, unit))
            throw new TextError(place, "MM/S, MM/MIN, CM/MIN or S", `"${unit.toUpperCase()}" is no unit of a speed.`);
        mark("unit", unit, place);
    }
    assignment(at) {
        const { cursor } = this;
        if (cursor.kind !== "word" || RESERVED.has(cursor.next))
            throw cursor.unexpected("the name of a variable");
        const to = readExpression(cursor, RULES, 0, 100);
        cursor.expect("=");
        return { kind: "assign", to, value: readExpression(cursor, RULES), global: false, ...at };
    }
    branches(at) {
        const { cursor } = this, branches = [];
        for (;;) {
            const when = readExpression(cursor, RULES);
            if (cursor.next === "goto")
                throw new TextError(cursor.here, "THEN", UNSAYABLE["goto"]);
            cursor.expect("then");
            branches.push({ when, body: this.body("IF", at, ["end", "elseif", "else"]) });
            if (!cursor.accept("elseif"))
                break;
        }
        const otherwise = cursor.accept("else") ? this.body("IF", at, ["end"]) : undefined;
        cursor.expect("end");
        return otherwise === undefined ? { kind: "if", branches, ...at } : { kind: "if", branches, otherwise, ...at };
    }
    /** DO … UNTIL goes through its body once before it asks. */
    untilLoop(at) {
        const { cursor } = this, body = this.body("DO", at, ["until"]);
        cursor.expect("until");
        const place = cursor.here, of = readExpression(cursor, RULES);
        const again = { kind: "while", when: { kind: "unary", sign: "not", of, ...place }, body, ...at };
        return { kind: "if", branches: [{ when: { kind: "truth", value: true, ...at }, body: [...body, again] }], ...at };
    }
    counting(at) {
        const { cursor } = this, variable = cursor.name("the name of the loop variable");
        cursor.expect("=");
        const from = readExpression(cursor, RULES);
        cursor.expect("to");
        const to = readExpression(cursor, RULES), one = { kind: "number", value: 1, ...at }, step = cursor.accept("step") ? readExpression(cursor, RULES) : one;
        const body = this.body("FOR", at, ["end"]);
        cursor.expect("end");
        return { kind: "for", variable, from, to, step, body, ...at };
    }
    /** CASE … OF is a chain of comparisons. */
    choice(at) {
        const { cursor } = this, of = readExpression(cursor, RULES), branches = [], ends = ["end", "value", "any"];
        cursor.expect("of");
        this.body("CASE", at, ends);
        let otherwise;
        while (!cursor.accept("end")) {
            if (cursor.accept("any")) {
                cursor.accept(":");
                otherwise = this.body("CASE", at, ends);
                continue;
            }
            cursor.expect("value");
            let when;
            do {
                const right = readExpression(cursor, RULES), equal = { kind: "binary", sign: "==", left: of, right, line: right.line, column: right.column };
                when = when === undefined ? equal : { kind: "binary", sign: "or", left: when, right: equal, line: right.line, column: right.column };
            } while (cursor.accept(","));
            cursor.accept(":");
            branches.push({ when, body: this.body("CASE", at, ends) });
        }
        return { kind: "if", branches, ...(otherwise === undefined ? {} : { otherwise }), ...at };
    }
}
/** A move with BREAK behind it stops at its target: the mark goes to the move. */
function withBreaks(block) {
    let move = -1;
    const marked = [];
    for (const statement of block) {
        if (statement.kind === "do" && statement.name === "break" && move >= 0) {
            const moved = marked[move];
            if (moved.kind === "do")
                marked[move] = { ...moved, args: [...moved.args, { name: "break", line: statement.line, column: statement.column }] };
        }
        if (statement.kind !== "comment")
            move = statement.kind === "do" && MOTIONS.has(statement.name) ? marked.length : -1;
        marked.push(statement);
    }
    return marked;
}
/** A value that is left out between commas is 0. */
const isLeftOut = (cursor) => cursor.kind === "sign" && (cursor.next === "," || cursor.next === ")");
/** `a, b)` behind an opening bracket; SHIFT has BY in place of a comma. */
function readArguments(cursor, depth) {
    const args = [];
    if (cursor.accept(")"))
        return args;
    do {
        const at = cursor.here;
        cursor.accept("&");
        args.push({ value: isLeftOut(cursor) ? { kind: "number", value: 0, ...at } : readExpression(cursor, RULES, depth + 1), ...at });
    } while (cursor.accept(",") || cursor.accept("by"));
    cursor.expect(")");
    return args;
}
/** `;* Title` at the top. */
function titleOf(block) {
    const first = block[0];
    return first?.kind === "comment" && first.text.startsWith("*") ? first.text.slice(1).trim() : undefined;
}
