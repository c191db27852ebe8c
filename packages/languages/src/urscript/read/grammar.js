import { TextError } from "../../text/index.ts";
import { TokenCursor, readExpression } from "../../text/structured/index.ts";
const LEXICON = {
    comment: "#", quotes: "\"'", doubled: false, lineEnds: true,
    signs: ["==", "!=", "<=", ">=", "(", ")", "[", "]", ",", ":", "=", "<", ">", "+", "-", "*", "/", "%", ".", "$", "@", ";"],
};
export const RESERVED = new Set([
    "and", "or", "not", "xor", "if", "elif", "else", "while", "def", "thread", "end", "return", "break", "continue", "global", "local", "halt",
    "run", "kill", "join", "sec", "enter_critical", "exit_critical", "True", "False", "pass",
]);
const RULES = {
    binary: { or: 1, xor: 1, and: 2, "==": 4, "!=": 4, "<": 4, ">": 4, "<=": 4, ">=": 4, "+": 5, "-": 5, "*": 6, "/": 6, "%": 6 },
    prefix: { not: 3, "-": 7, "+": 7 },
    constants: { True: true, False: false },
    tags: ["p"], index: "[", components: false, reserved: RESERVED, args: readArguments,
};
/** Deepest nesting of blocks: more than anybody writes, less than the stack holds. */
const DEPTH = 50;
const MOST_FAULTS = 50;
/** Reads URScript. Goes on after a fault, so that all of them are told at once. */
export const readSource = (text) => new Reader(text).source();
class Reader {
    cursor;
    faults = [];
    routines = new Map();
    depth = 0;
    constructor(text) { this.cursor = new TokenCursor(text, LEXICON, word => word); }
    source() {
        const loose = [], defined = [];
        this.guard(() => { this.cursor.advance(); });
        while (!this.cursor.done && this.faults.length < MOST_FAULTS) {
            this.comments(loose);
            const first = this.routines.size, statement = this.line();
            if (statement !== undefined)
                loose.push(statement);
            if (this.routines.size > first)
                defined.push([...this.routines.values()].at(-1));
        }
        if (this.faults.length > 0)
            return { kind: "not-understood", faults: this.faults };
        // What stands outside runs; otherwise the program is the one definition, which the controller starts by itself.
        const entry = defined.at(-1);
        if (loose.some(({ kind }) => kind !== "comment") || entry === undefined)
            return { kind: "source", source: { title: titleOf(loose) ?? entry?.name ?? "Program", routines: this.routines, main: loose } };
        this.routines.delete(entry.name);
        return { kind: "source", source: { title: titleOf(entry.body) ?? entry.name, routines: this.routines, main: entry.body } };
    }
    guard(read) {
        try {
            return read();
        }
        catch (cause) {
            if (!(cause instanceof TextError))
                throw cause;
            this.faults.push(cause.fault);
            this.cursor.skip(cursor => cursor.kind === "line-end");
            return undefined;
        }
    }
    /** One statement with the end of its line; undefined for an empty line, a label, a definition and a fault. */
    line() {
        const { cursor } = this;
        return this.guard(() => {
            if (cursor.kind === "line-end" || cursor.next === ";") {
                cursor.advance();
                return undefined;
            }
            // `$ 5 "A"` names the node of the pendant's program; `@` marks belong to its tools.
            if (cursor.next === "$" || cursor.next === "@") {
                cursor.skip(each => each.kind === "line-end");
                return undefined;
            }
            const statement = this.statement();
            if (!cursor.isAt("end") && cursor.next !== ";") {
                if (!cursor.isAt("line-end"))
                    throw cursor.unexpected("the end of the statement");
                cursor.advance();
            }
            return statement;
        });
    }
    comments(block) {
        for (let comment = this.cursor.comment(); comment !== undefined; comment = this.cursor.comment())
            block.push({ kind: "comment", ...comment });
    }
    body(opened, at, ends) {
        const { cursor } = this, statements = [];
        if (++this.depth > DEPTH)
            throw new TextError(at, "a simpler program", `Blocks are nested more than ${DEPTH} deep.`);
        while (!ends.includes(cursor.next)) {
            if (cursor.done || this.faults.length >= MOST_FAULTS) {
                this.depth--;
                throw new TextError(cursor.here, "end", `The ${opened} of line ${at.line} is not closed.`);
            }
            this.comments(statements);
            if (ends.includes(cursor.next))
                break;
            const statement = this.line();
            if (statement !== undefined)
                statements.push(statement);
        }
        this.comments(statements);
        this.depth--;
        return statements;
    }
    statement() {
        const { cursor } = this, at = cursor.here, word = cursor.next;
        if (cursor.kind !== "word")
            throw cursor.unexpected("a statement");
        switch (word) {
            case "def":
                cursor.advance();
                this.definition(at);
                return undefined;
            case "if":
                cursor.advance();
                return this.branches(at);
            case "while": {
                cursor.advance();
                const when = readExpression(cursor, RULES);
                cursor.expect(":");
                const body = this.body("while", at, ["end"]);
                cursor.expect("end");
                return asWait({ kind: "while", when, body, ...at });
            }
            case "return": {
                cursor.advance();
                return cursor.isAt("line-end") || cursor.done ? { kind: "return", ...at } : { kind: "return", value: readExpression(cursor, RULES), ...at };
            }
            case "break":
            case "continue":
            case "halt":
                cursor.advance();
                return { kind: word, ...at };
            case "pass":
                cursor.advance();
                return undefined;
            case "global":
            case "local":
                cursor.advance();
                return this.assignment(at, word === "global");
            case "thread":
            case "run":
            case "kill":
            case "join":
            case "sec":
            case "enter_critical":
            case "exit_critical":
                throw new TextError(at, "a statement of one task", `"${word}" belongs to threads, which are not executed here.`);
            default: break;
        }
        if (RESERVED.has(word))
            throw cursor.unexpected(word === "end" ? "a statement, since no block is open" : "a statement");
        if (cursor.second !== "(")
            return this.assignment(at, false);
        cursor.advance();
        cursor.advance();
        return { kind: "do", name: word, args: readArguments(cursor, 0), ...at };
    }
    assignment(at, global) {
        const { cursor } = this, word = cursor.raw;
        if (cursor.kind !== "word" || RESERVED.has(cursor.next))
            throw cursor.unexpected("the name of a variable");
        const second = cursor.second;
        if (second !== "=" && second !== "[") {
            throw new TextError(at, "a statement of URScript", `"${word}" is no statement of URScript that is understood here.`);
        }
        const to = readExpression(cursor, RULES, 0, 100);
        cursor.expect("=");
        return { kind: "assign", to, value: readExpression(cursor, RULES), global, ...at };
    }
    branches(at) {
        const { cursor } = this, branches = [];
        for (;;) {
            const when = readExpression(cursor, RULES);
            cursor.expect(":");
            branches.push({ when, body: this.body("if", at, ["end", "elif", "else"]) });
            if (!cursor.accept("elif"))
                break;
        }
        let otherwise;
        if (cursor.accept("else")) {
            cursor.expect(":");
            otherwise = this.body("if", at, ["end"]);
        }
        cursor.expect("end");
        return otherwise === undefined ? { kind: "if", branches, ...at } : { kind: "if", branches, otherwise, ...at };
    }
    definition(at) {
        const { cursor } = this, place = cursor.here, name = cursor.name("the name of the program");
        if (RESERVED.has(name))
            throw new TextError(place, "a name that is no word of the language", `"${name}" is a word of URScript.`);
        const parameters = [];
        cursor.expect("(");
        while (!cursor.accept(")")) {
            const parameter = cursor.name("the name of a parameter");
            parameters.push(cursor.accept("=") ? { name: parameter, type: "", value: readExpression(cursor, RULES) } : { name: parameter, type: "" });
            if (!cursor.accept(",") && cursor.next !== ")")
                throw cursor.unexpected("\",\" or \")\"");
        }
        cursor.expect(":");
        // Script files that are taken in twice define their programs anew: the last one counts.
        const body = this.body(`def ${name}`, at, ["end"]);
        cursor.expect("end");
        this.routines.set(name, { name, parameters, body, ...place });
    }
}
/** `a, b=2)` behind an opening bracket. */
function readArguments(cursor, depth) {
    const args = [];
    if (cursor.accept(")"))
        return args;
    do {
        const at = cursor.here;
        if (cursor.kind === "word" && cursor.second === "=") {
            const name = cursor.take();
            cursor.advance();
            args.push({ name, value: readExpression(cursor, RULES, depth + 1), ...at });
        }
        else
            args.push({ value: readExpression(cursor, RULES, depth + 1), ...at });
    } while (cursor.accept(","));
    cursor.expect(")");
    return args;
}
/** `#* Title` at the top. */
function titleOf(block) {
    const first = block[0];
    return first?.kind === "comment" && first.text.startsWith("*") ? first.text.slice(1).trim() : undefined;
}
/** Instructions that only let time pass. */
const IDLE = new Set(["sync", "sleep"]);
/** `while (not input): sync() end` rests until the input is there: no loop to whoever reads it. */
function asWait(loop) {
    const { when, body, line, column } = loop;
    const steps = body.filter(({ kind }) => kind !== "comment");
    if (steps.length === 0 || !steps.every(each => each.kind === "do" && IDLE.has(each.name)) || !readsInput(when))
        return loop;
    return { kind: "wait-until", when: when.kind === "unary" && when.sign === "not" ? when.of : { kind: "unary", sign: "not", of: when, line, column }, line, column };
}
function readsInput(expression) {
    switch (expression.kind) {
        case "call": return /^get_.*(digital|analog)_(in|out)$/.test(expression.name);
        case "unary": return readsInput(expression.of);
        case "binary": return readsInput(expression.left) || readsInput(expression.right);
        default: return false;
    }
}
