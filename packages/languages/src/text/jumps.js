import { TextError } from "./faults.ts";
/** Turns the lines of one list into instructions with jumps, so that GOTO and blocks are one thing. */
export class JumpBuilder {
    name;
    code = [];
    slots = 0;
    rules;
    open = [];
    labels = new Map();
    gotos = [];
    constructor(name, rules) {
        this.name = name;
        this.rules = rules;
    }
    /** Gives every jump its place. @throws {TextError} for a block without its end, or a GOTO to a label that is not there. */
    close(end) {
        const block = this.open.at(-1);
        if (block !== undefined)
            throw new TextError(block.at, this.rules.endOf(block.word), `The ${block.word} of line ${block.at.line} is not closed before line ${end.line}.`);
        for (const { jump, label, at } of this.gotos) {
            const to = this.labels.get(label);
            if (to === undefined)
                throw new TextError(at, `a label of this ${this.rules.called}`, `Label ${label} is not in ${this.rules.called} ${this.name}.`);
            jump.to = to;
        }
    }
    push(instruction) {
        this.code.push(instruction);
        return instruction;
    }
    label(label, at) {
        if (this.labels.has(label))
            throw new TextError(at, "a label used once", `Label ${label} is in ${this.rules.called} ${this.name} twice.`);
        this.labels.set(label, this.code.length);
    }
    goto(jump, label, at) { this.gotos.push({ jump, label, at }); }
    /** A block that is opened by its word alone. */
    begin(cursor, kind) {
        const at = cursor.here, word = cursor.take().toUpperCase();
        cursor.expectEnd();
        this.open.push({ kind, word, at, start: this.code.length, leaves: [] });
    }
    openIf(condition, at) {
        this.open.push({ kind: "if", word: "IF", at, start: this.code.length, leaves: [], miss: this.push({ kind: "unless", condition, to: -1 }) });
    }
    readElse(cursor) {
        const block = this.open.at(-1);
        if (block?.kind !== "if" || block.miss === undefined)
            throw cursor.unexpected("a statement, since no IF is open");
        block.leaves.push(this.push({ kind: "jump", to: -1, at: cursor.here }));
        block.miss.to = this.code.length;
        block.miss = undefined;
        cursor.take();
        cursor.expectEnd();
    }
    /** @param then  a word behind the condition. */
    readWhile(cursor, at, then) {
        cursor.take();
        const condition = this.rules.expression(cursor), start = this.code.length;
        this.open.push({ kind: "while", word: "WHILE", at, start, leaves: [this.push({ kind: "unless", condition, to: -1 })] });
        if (then !== undefined)
            cursor.expect(then);
        cursor.expectEnd();
    }
    /** @param word  what opens the block that UNTIL closes. */
    readUntil(cursor, word) {
        const block = this.open.at(-1);
        if (block?.kind !== "until")
            throw cursor.unexpected(`a statement, since no ${word} is open`);
        cursor.take();
        this.push({ kind: "unless", condition: this.rules.expression(cursor), to: block.start });
        cursor.expectEnd();
        this.leave(block);
    }
    readFor(cursor, at) {
        const { expression } = this.rules;
        cursor.take();
        const variable = this.rules.variable(cursor);
        cursor.expect("=");
        const from = expression(cursor);
        cursor.expect("TO");
        const last = expression(cursor);
        const step = cursor.accept("STEP") ? expression(cursor) : undefined;
        cursor.expectEnd();
        const slot = this.slots++;
        this.push({ kind: "for", variable, from, last, step, slot });
        const start = this.code.length;
        this.open.push({ kind: "for", word: "FOR", at, start, slot, variable, leaves: [this.push({ kind: "for-check", variable, slot, to: -1 })] });
    }
    /** @param then  a word behind the value. */
    readSwitch(cursor, at, then) {
        const word = cursor.take().toUpperCase(), value = this.rules.expression(cursor);
        if (then !== undefined)
            cursor.expect(then);
        cursor.expectEnd();
        const slot = this.slots++;
        this.push({ kind: "switch", value, slot });
        this.open.push({ kind: "switch", word, at, slot, start: this.code.length, leaves: [], miss: undefined, isLast: false });
    }
    /** @param colon  whether one stands behind the values. */
    readCase(cursor, words, colon) {
        const block = this.branch(cursor, words), values = [this.rules.expression(cursor)];
        while (cursor.accept(","))
            values.push(this.rules.expression(cursor));
        if (colon)
            cursor.expect(":");
        cursor.expectEnd();
        block.miss = this.push({ kind: "case-unless", values, slot: block.slot, to: -1 });
    }
    readLastCase(cursor, words) {
        this.branch(cursor, words).isLast = true;
        cursor.accept(":");
        cursor.expectEnd();
    }
    branch(cursor, { opens, ends, last }) {
        const block = this.open.at(-1);
        if (block?.kind !== "switch")
            throw cursor.unexpected(`a statement, since no ${opens} is open`);
        if (block.isLast)
            throw cursor.unexpected(`${ends}, since ${last} is the last branch`);
        if (this.code.length > block.start)
            block.leaves.push(this.push({ kind: "jump", to: -1, at: cursor.here }));
        if (block.miss !== undefined)
            block.miss.to = this.code.length;
        block.miss = undefined;
        cursor.take();
        return block;
    }
    readEnd(cursor) {
        const block = this.open.at(-1), ends = block === undefined ? undefined : this.rules.endOf(block.word);
        if (block === undefined || block.kind === "until" || cursor.next !== ends)
            throw cursor.unexpected(ends ?? "a statement, since no block is open");
        const at = cursor.here;
        cursor.take();
        cursor.expectEnd();
        if (block.kind === "while" || block.kind === "loop")
            this.push({ kind: "jump", to: block.start, at });
        if (block.kind === "for")
            this.push({ kind: "for-next", variable: block.variable, slot: block.slot, to: block.start });
        if ((block.kind === "if" || block.kind === "switch") && block.miss !== undefined)
            block.miss.to = this.code.length;
        this.leave(block);
    }
    /** Leaves the innermost loop. */
    readExit(cursor, at) {
        const loop = this.open.findLast(({ kind }) => kind !== "if" && kind !== "switch");
        if (loop === undefined)
            throw cursor.unexpected("a statement, since no loop is open");
        cursor.take();
        cursor.expectEnd();
        loop.leaves.push(this.push({ kind: "jump", to: -1, at }));
    }
    leave(block) {
        for (const jump of block.leaves)
            jump.to = this.code.length;
        this.open.pop();
    }
}
