import { TextError, textFault } from "../faults.ts";
import { fitPallet } from "./pallet.ts";
import { isSteady } from "./steady.ts";
/** More steps than this are taken for a program that repeats itself for ever. */
const MOST_STEPS = 200_000;
/** Rounds of a loop that are compared one by one. */
const MOST_LOOKS = 50;
/** Writes a program down as steps that keep its loops, decisions and calls. Loops that do something else each time are written out. */
export class Outline {
    groups = {};
    routines = {};
    pallets = {};
    warnings = [];
    machine;
    spelt;
    /** Routines that end the whole program. */
    endsAll = new Set();
    name;
    group;
    groupCount = 0;
    count = 0;
    /** @param spelt  a name as the text has it, where the language does not tell capital letters from small ones. */
    constructor(machine, spelt = name => name) {
        this.machine = machine;
        this.spelt = spelt;
    }
    /** @throws {TextError} where the text cannot be executed, or leaves a block in a way that steps cannot. */
    steps(block) {
        const steps = [];
        this.block(block, steps);
        return steps;
    }
    block(block, out) {
        for (const statement of block) {
            const flow = this.statement(statement, out);
            if (flow !== "next")
                return flow;
        }
        return "next";
    }
    statement(statement, out) {
        const { machine } = this;
        switch (statement.kind) {
            case "comment":
                this.comment(statement.text, out);
                return "next";
            case "if": return this.decision(statement, out);
            case "while":
            case "for": return this.loop(statement, out);
            case "do": {
                const routine = machine.routine(statement.name);
                if (routine === undefined || statement.args.length > 0 || routine.parameters.length > 0)
                    return this.run(machine.statement(statement), out);
                const name = this.spelt(routine.name), step = this.dress();
                if (!Object.hasOwn(this.routines, name)) {
                    this.routines[name] = [];
                    const inside = [];
                    if (this.fresh(() => { this.group = undefined; return machine.inside(routine, () => this.block(routine.body, inside)); }) === "halt")
                        this.endsAll.add(name);
                    this.routines[name] = inside;
                }
                machine.edge();
                this.add(out, { ...step, type: "call", routine: name }, statement);
                return this.endsAll.has(name) ? "halt" : "next";
            }
            default: return this.run(machine.statement(statement), out);
        }
    }
    run(executed, out) {
        for (;;) {
            const next = executed.next();
            if (next.done === true)
                return next.value;
            const { step, line } = next.value;
            if (step !== undefined)
                this.add(out, { ...step, ...this.dress() }, { line, column: 1 });
        }
    }
    add(out, step, at) {
        if (out.length >= MOST_STEPS)
            throw new TextError(at, "a program that ends", `The program has more than ${MOST_STEPS} steps: it repeats itself for ever.`);
        out.push(step);
    }
    /** Id, name and group of the next step. */
    dress() {
        const { name, group } = this;
        this.name = undefined;
        return { id: `s${++this.count}`, ...(name === undefined ? {} : { name }), ...(group === undefined ? {} : { group }) };
    }
    /** A name before a step, `== name` before a group of steps, `- text` for a remark, `*` for neither. */
    comment(text, out) {
        if (text.startsWith("==")) {
            const title = text.replace(/^=+\s*/, "");
            this.group = title === "" ? undefined : `g${++this.groupCount}`;
            if (this.group !== undefined)
                this.groups[this.group] = { name: title };
        }
        else if (text.startsWith("-"))
            out.push({ id: `s${++this.count}`, type: "comment", text: text.slice(1).trim(), ...(this.group === undefined ? {} : { group: this.group }) });
        else if (text !== "" && !text.startsWith("*"))
            this.name = text;
    }
    /** Inside a block names and groups begin anew. */
    fresh(read) {
        const { group } = this;
        this.name = undefined;
        this.machine.edge();
        const answer = read();
        this.machine.edge();
        this.group = group;
        this.name = undefined;
        return answer;
    }
    decision(statement, out) {
        const { machine } = this, [first, ...others] = statement.branches;
        const when = machine.condition(first.when);
        if (when === undefined) {
            for (const { when: each, body } of statement.branches)
                if (machine.isTrue(each))
                    return this.block(body, out);
            return statement.otherwise === undefined ? "next" : this.block(statement.otherwise, out);
        }
        const step = this.dress(), then = [], otherwise = [], back = machine.remember();
        const flows = [this.fresh(() => this.block(first.body, then))];
        const rest = others.length > 0
            ? [{ ...statement, branches: others }]
            : statement.otherwise ?? [];
        const after = machine.remember();
        back();
        flows.push(this.fresh(() => this.block(rest, otherwise)));
        after();
        if (flows.some(flow => flow !== "next" && flow !== "halt"))
            throw new TextError(statement, "a decision that goes on behind its end", "The decision leaves its block, which steps cannot.");
        this.add(out, { ...step, type: "if", when, then, ...(otherwise.length === 0 && others.length === 0 && statement.otherwise === undefined ? {} : { else: otherwise }) }, statement);
        return "next";
    }
    loop(statement, out) {
        const { machine } = this;
        if (statement.kind === "while" && isForever(statement))
            return this.repeat(statement, "forever", statement.body, out);
        const counter = this.counter(statement);
        if (counter !== undefined && counter.times > 0) {
            if (this.pallet(statement, counter, out))
                return "next";
            const back = machine.remember(), { count, groupCount, name, group } = this;
            const isSame = this.isSame(counter);
            back();
            this.count = count;
            this.groupCount = groupCount;
            this.name = name;
            this.group = group;
            if (isSame) {
                machine.setCount(counter.name, counter.from);
                const flow = this.repeat(statement, counter.times, counter.body, out);
                machine.setCount(counter.name, counter.from + counter.step * counter.times);
                return flow;
            }
        }
        const before = out.length;
        const flow = this.run(machine.statement(statement), out);
        if (out.length > before)
            this.warnings.push(textFault(statement, "a loop that does the same each time", `The loop of line ${statement.line} was written out: it became ${out.length - before} steps.`));
        return flow;
    }
    repeat(statement, times, body, out) {
        const step = this.dress(), steps = [];
        const flow = this.fresh(() => this.block(body, steps));
        if (flow !== "next" && flow !== "halt")
            throw new TextError(statement, "a loop that runs to its end", "The loop is left from inside, which steps cannot.");
        this.add(out, { ...step, type: "repeat", times, steps }, statement);
        return "next";
    }
    /** Whether every round does the same. Where a variable tells the rounds apart all of them are looked at, as long as they are few. */
    isSame({ name, from, step, times, body }) {
        const looks = Math.min(times, isSteady(body, name, routine => this.machine.routine(routine)) ? 2 : MOST_LOOKS + 1);
        if (looks > MOST_LOOKS)
            return false;
        let first;
        for (let i = 0; i < looks; i++) {
            this.machine.setCount(name, from + step * i);
            const round = this.trial(body);
            if (round === undefined || (i > 0 && round !== first))
                return false;
            first = round;
        }
        return true;
    }
    /** The steps of a body as one text to compare; undefined when it leaves the loop. */
    trial(body) {
        const steps = [], { warnings, count, groupCount } = this, kept = warnings.length;
        const flow = this.fresh(() => this.block(body, steps));
        warnings.length = kept;
        this.count = count;
        this.groupCount = groupCount;
        return flow === "next" ? JSON.stringify(steps) : undefined;
    }
    /** `for i`, or `while i < n: … i = i + 1 end` where nothing else changes i. */
    counter(statement) {
        const { machine } = this;
        if (statement.kind === "for") {
            const [from, last, step] = machine.counting(statement);
            return step === 0 ? undefined : { name: statement.variable, from, step, times: Math.max(0, Math.floor((last - from) / step + 1e-9) + 1), body: statement.body };
        }
        const { when, body } = statement, end = body.findLast(({ kind }) => kind !== "comment");
        if (when.kind !== "binary" || when.left.kind !== "variable" || (when.sign !== "<" && when.sign !== "<=") || end?.kind !== "assign")
            return undefined;
        const { name } = when.left, { to, value } = end;
        if (to.kind !== "variable" || to.name !== name || value.kind !== "binary" || value.sign !== "+" || value.left.kind !== "variable" || value.left.name !== name || value.right.kind !== "number")
            return undefined;
        const step = value.right.value, rest = body.filter(each => each !== end);
        if (!(step > 0) || assigns(rest, name))
            return undefined;
        const from = machine.numberOf(when.left), limit = machine.numberOf(when.right);
        const times = when.sign === "<" ? Math.ceil((limit - from) / step - 1e-9) : Math.floor((limit - from) / step + 1e-9) + 1;
        return { name, from, step, times: Math.max(0, times), body: rest };
    }
    /** A nest of loops that puts place after place of a pattern into one variable, and does the same at each. */
    pallet(statement, outer, out) {
        const found = this.nest(outer);
        if (found === undefined)
            return false;
        const { machine } = this, { place, body, counts } = found, variable = this.spelt(found.variable), back = machine.remember();
        const wasPlace = machine.places.has(variable), places = [], visits = [];
        let frame, same = true, visit = [];
        machine.places.add(variable);
        const close = () => { if (places.length > 0)
            visits.push(JSON.stringify(visit.map(step => ({ ...step, id: "" })))); visit = []; };
        try {
            for (const { line, step } of machine.statement(statement)) {
                if (step !== undefined)
                    visit.push(step);
                else if (line === place.line) {
                    close();
                    const now = machine.placeIn(found.variable);
                    same &&= now !== undefined && (frame === undefined || frame === now.frame);
                    if (now !== undefined) {
                        frame = now.frame;
                        places.push(now.pose);
                    }
                    if (places.length > MOST_STEPS)
                        same = false;
                }
                if (!same)
                    break;
            }
        }
        finally {
            back();
        }
        close();
        const [layers, lines, inLine] = [1, 1, 1, ...counts].slice(-3);
        const pallet = same && counts.length <= 3 && visits.every(each => each === visits[0]) ? fitPallet(places, frame ?? "world", layers, lines, inLine) : undefined;
        if (pallet === undefined || (Object.hasOwn(this.pallets, variable) && JSON.stringify(this.pallets[variable]) !== JSON.stringify(pallet))) {
            if (!wasPlace)
                machine.places.delete(variable);
            return false;
        }
        this.pallets[variable] = pallet;
        const step = this.dress(), steps = [];
        for (const { name, from } of found.counters)
            machine.setCount(name, from);
        for (const each of found.before)
            this.silently(each);
        this.fresh(() => this.block(body, steps));
        this.add(out, { ...step, type: "pallet", pallet: variable, steps }, statement);
        return true;
    }
    /** Executes a statement of which only the effect on variables counts. */
    silently(statement) {
        const doing = this.machine.statement(statement);
        while (doing.next().done !== true)
            ;
    }
    nest(outer) {
        const counts = [], counters = [], { machine } = this, back = machine.remember();
        try {
            for (let counter = outer; counter !== undefined;) {
                counts.push(counter.times);
                counters.push(counter);
                machine.setCount(counter.name, counter.from);
                const body = counter.body.filter(({ kind }) => kind !== "comment"), loops = body.filter((each) => each.kind === "while" || each.kind === "for");
                if (loops.length === 1 && !body.some(({ kind }) => kind === "do" || kind === "wait-until")) {
                    for (const each of body)
                        if (each.kind === "assign")
                            this.silently(each); // the start of the inner counter
                    counter = this.counter(loops[0]);
                    continue;
                }
                for (const [i, each] of counter.body.entries()) {
                    if (each.kind === "comment")
                        continue;
                    if (each.kind !== "assign" && each.kind !== "if")
                        return undefined;
                    this.silently(each);
                    const variable = each.kind === "assign" ? holder(each.to) : undefined;
                    if (variable !== undefined && machine.placeIn(variable) !== undefined) {
                        return { variable, place: each, before: counter.body.slice(0, i + 1), body: counter.body.slice(i + 1), counts, counters };
                    }
                }
                return undefined;
            }
            return undefined;
        }
        finally {
            back();
        }
    }
}
/** The variable that an assignment changes, as a whole or in part. */
function holder(to) {
    let of = to;
    while (of.kind === "component" || of.kind === "index")
        of = of.of;
    return of.kind === "variable" ? of.name : undefined;
}
const isForever = ({ when }) => when.kind === "truth" && when.value;
function assigns(block, name) {
    return block.some(statement => {
        switch (statement.kind) {
            case "assign": return holder(statement.to) === name;
            case "if": return statement.branches.some(({ body }) => assigns(body, name)) || (statement.otherwise !== undefined && assigns(statement.otherwise, name));
            case "while":
            case "for": return assigns(statement.body, name);
            default: return false;
        }
    });
}
