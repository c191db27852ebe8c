import { TextError } from "../faults.ts";
import { BlockMachine, constantsOf } from "../structured/index.ts";
import { NOWHERE, asPose, on } from "./rigid.ts";
import { UprightArm, inRadians } from "./upright.ts";
import { arithmetic, numberIn, placeIn, sortOf } from "./values.ts";
/** Executes a BASIC statement by statement. S holds what instructions have said: plain values, which are copied to be remembered. */
export class BasicMachine extends BlockMachine {
    surroundings;
    /** Variables whose place is a frame although it changes: the places of a pallet that is being read. */
    places = new Set();
    arm;
    state;
    /** Variables that never change: a place in one of them is a frame of the program. */
    constants;
    /** Frames by their names, from the base. */
    frames = new Map();
    outputs = new Map();
    signals;
    tool = "flange";
    /** Whether the tool was said where the program is now; joint angles alone do not ask for one. */
    hasTool = false;
    constructor({ source, robot, worldFromBase, surroundings, signals }, upright, state) {
        super(source.routines);
        this.arm = new UprightArm(robot, upright, worldFromBase);
        this.constants = constantsOf(source.main, source.routines.values());
        this.surroundings = surroundings;
        this.signals = signals;
        this.state = state;
    }
    /** Signs between places; undefined for numbers and texts. */
    joined(_sign, _left, _right, _of) { return undefined; }
    component(_of, name, at) { throw new TextError(at, "a variable", `There is no component ${name}.`); }
    // --- values -----------------------------------------------------------------------------------------------------
    variable(name) { return this.scopes.at(-1)?.names.get(name) ?? this.globals.get(name); }
    /** A variable as it is kept: `p[3]` for the third of a row of places. */
    keyOf(expression) {
        if (expression.kind === "variable")
            return expression.name;
        const numbers = (of) => of.map(index => this.numberOf(index)).join(",");
        if (expression.kind === "index" && expression.of.kind === "variable")
            return `${expression.of.name}[${numbers(expression.indices)}]`;
        if (expression.kind === "call")
            return `${expression.name}[${numbers(expression.args.flatMap(({ value }) => value === undefined ? [] : [value]))}]`;
        throw new TextError(expression, "a variable", "Only a variable can be given a value.");
    }
    evaluate(expression) {
        switch (expression.kind) {
            case "number":
            case "text": return expression.value;
            case "truth": return expression.value ? this.truth : 0;
            case "variable": {
                const value = this.variable(expression.name) ?? this.known(expression.name);
                if (value === undefined)
                    throw new TextError(expression, "a variable that has a value", `"${expression.name}" has no value yet.`);
                return value;
            }
            case "index": {
                const key = this.keyOf(expression), value = this.variable(key) ?? this.digital(expression);
                if (value === undefined)
                    throw new TextError(expression, "a variable that has a value", `"${key}" has no value yet.`);
                return value;
            }
            case "list": throw new TextError(expression, "a value", "A list of numbers stands where a value is expected.");
            case "component": return this.component(this.evaluate(expression.of), expression.name, expression);
            case "unary": {
                const value = numberIn(this.evaluate(expression.of), expression);
                return expression.sign === "not" ? (value === 0 ? this.truth : 0) : -value;
            }
            case "binary": {
                const { sign, left, right } = expression, a = this.evaluate(left);
                if (sign === "and" && a === 0)
                    return 0;
                const b = this.evaluate(right);
                return this.joined(sign, a, b, expression) ?? arithmetic(sign, a, b, is => is ? this.truth : 0, expression);
            }
            case "call": {
                const routine = this.routine(expression.name);
                if (routine !== undefined)
                    return this.answer(routine, expression.args, expression);
                return this.digital(expression) ?? this.applied(expression);
            }
        }
    }
    isTrue(expression) { return this.numberOf(expression) !== 0; }
    numberOf(expression) { return numberIn(this.evaluate(expression), expression); }
    fromNumber(value) { return value; }
    /** The argument of that place, which must be there. */
    given({ name, args, line, column }, i, what) {
        const value = args[i]?.value;
        if (value === undefined)
            throw new TextError({ line, column }, what, `${name} is said without ${what}.`);
        return value;
    }
    /** The numbers of a list of arguments; those left out are 0. */
    numbers(args) { return args.map(({ value }) => value === undefined ? 0 : this.numberOf(value)); }
    store(to, value) {
        const key = this.keyOf(to), scope = this.scopes.at(-1)?.names;
        // Places belong to the controller, numbers to the routine that counts with them.
        (scope === undefined || this.globals.has(key) || typeof value === "object" ? this.globals : scope).set(key, value);
    }
    // --- lines ------------------------------------------------------------------------------------------------------
    /** The line of that number, under the name of the variable that holds the number, else DO3 and its like. */
    line(of, kind) {
        const { signals } = this.surroundings, address = this.numberOf(of);
        if (!Number.isInteger(address) || address < 0)
            throw new TextError(of, "the number of a line", `There is no line ${address}.`);
        const found = Object.entries(signals).find(([, line]) => line.address === address && line.kind === kind)?.[0];
        if (found !== undefined)
            return found;
        const wanted = of.kind === "variable" ? of.name : "", name = wanted !== "" && !Object.hasOwn(signals, wanted) ? wanted : `${kind === "digital-in" ? "DI" : "DO"}${address}`;
        signals[name] = { kind, address };
        return name;
    }
    set(signal, to, id, pulse_s) {
        this.outputs.set(signal, to);
        return { id, type: "set", signal, to, ...(pulse_s === undefined ? {} : { pulse_s }) };
    }
    digital(expression) {
        const signal = this.lineIn(expression);
        return signal === undefined ? undefined : this.read(signal) ? this.truth : 0;
    }
    read(signal) { return this.outputs.get(signal) ?? (this.signals?.read(signal) === true); }
    holds(when) { return "is" in when && this.read(when.signal) === when.is; }
    /** The condition of one line that an expression is, if it is one. */
    condition(expression) {
        if (expression.kind === "unary" && expression.sign === "not") {
            const inner = this.condition(expression.of);
            return inner !== undefined && "is" in inner ? { signal: inner.signal, is: !inner.is } : undefined;
        }
        if (expression.kind === "binary" && (expression.sign === "=" || expression.sign === "<>")) {
            const signal = this.lineIn(expression.left), { right } = expression;
            if (signal === undefined || (right.kind !== "number" && right.kind !== "truth"))
                return undefined;
            return { signal, is: (right.value !== 0 && right.value !== false) === (expression.sign === "=") };
        }
        const signal = this.lineIn(expression);
        return signal === undefined ? undefined : { signal, is: true };
    }
    *waitUntil(statement) {
        const when = this.condition(statement.when);
        if (when === undefined)
            throw new TextError(statement.when, "one line that is waited for", "Only a wait for one line can be carried out.");
        if (this.outputs.has(when.signal) && !this.holds(when))
            throw new TextError(statement.when, "a condition that comes true", "The program waits for an output that nothing here changes.");
        const timeout_s = statement.timeout === undefined ? undefined : this.numberOf(statement.timeout);
        yield this.done(statement, { id: this.stepId(statement), type: "wait-for", when, ...(timeout_s === undefined ? {} : { timeout_s }) });
    }
    // --- how an outline reads it ------------------------------------------------------------------------------------
    placeIn(variable) {
        const value = this.variable(variable);
        return typeof value === "object" && value.kind === "place" ? this.poseOf(value) : undefined;
    }
    edge() { this.hasTool = false; }
    remember() {
        const values = super.remember(), arm = this.arm.remember(), outputs = new Map(this.outputs), state = { ...this.state }, frames = new Map(this.frames), { tool, hasTool } = this;
        return () => {
            values();
            arm();
            this.outputs.clear();
            for (const [line, value] of outputs)
                this.outputs.set(line, value);
            this.frames.clear();
            for (const [name, value] of frames)
                this.frames.set(name, value);
            this.state = { ...state };
            this.tool = tool;
            this.hasTool = hasTool;
        };
    }
    // --- moves ------------------------------------------------------------------------------------------------------
    *instruction(statement) {
        const steps = this.steps(statement);
        for (const step of steps)
            yield this.done(statement, step);
        if (steps.length === 0)
            yield { line: statement.line };
        return undefined;
    }
    /** @param name  what the program calls the tool; undefined for the bare flange. */
    useTool(of, name) {
        this.arm.tool = of;
        this.hasTool = true;
        this.tool = name === undefined ? "flange" : kept(this.surroundings.tools, asPose(of), name);
    }
    placed(at, frame = "") { return { kind: "place", at, frame }; }
    /** The place alone, wherever it was made of. */
    unbound({ at, frame, posture }) { return { kind: "place", at, frame, ...(posture === undefined ? {} : { posture }) }; }
    /** From the base, whatever frame its numbers count in. */
    inBase({ at, frame }) { return frame === "" ? at : on(this.frames.get(frame) ?? NOWHERE, at); }
    /** Where a motion goes: remembered as where the arm then is. `asks` for the posture that the place names. */
    go(goal, isJoint, asks, at) {
        const { arm, tool } = this;
        if (typeof goal === "object" && goal.kind === "joints") {
            if (isJoint)
                arm.goneToAngles(goal.deg);
            else
                arm.goneTo(arm.atAngles(goal.deg));
            return { q: inRadians(goal.deg), ...(isJoint && !this.hasTool ? {} : { tool }) };
        }
        if (typeof goal !== "object" || goal.kind === "shift")
            throw new TextError(at, "a place", `${sortOf(goal).replace(/^./, letter => letter.toUpperCase())} is no place to move to.`);
        const place = this.inBase(goal), posture = asks && goal.posture !== undefined && Object.keys(goal.posture).length > 0 ? goal.posture : undefined;
        const branch = posture === undefined ? undefined : arm.branchAt(place, posture);
        if (posture !== undefined && branch === undefined)
            throw new TextError(at, "a place that is reached so", "The place cannot be reached in the posture that is asked for.");
        arm.goneTo(place);
        return { ...this.poseOf(goal), tool, ...(branch === undefined ? {} : { branch }) };
    }
    /** The middle of an arc is passed, not reached. */
    passing(goal, at) {
        if (typeof goal === "object" && goal.kind === "joints")
            return { q: inRadians(goal.deg), tool: this.tool };
        return { ...this.poseOf(placeIn(goal, at)), tool: this.tool };
    }
    move(statement, path, target, more) {
        return { id: this.stepId(statement), type: "move", path, target, ...more };
    }
    poseOf({ at, frame, within }) {
        if (within !== undefined) {
            const { variable, of } = within, { frames } = this.surroundings;
            if (!this.places.has(variable))
                frames[variable] ??= this.arm.inWorld(of);
            return { pose: asPose(within.at), frame: variable };
        }
        if (frame === "")
            return { pose: this.arm.inWorld(at), frame: "world" };
        return { pose: asPose(at), frame };
    }
    /** A frame that numbers count in from now on, under the name of the variable that holds its number. */
    frameAt(name, of) {
        this.frames.set(name, of);
        this.surroundings.frames[name] ??= this.arm.inWorld(of);
    }
}
/** A place met before keeps its name; two never share one. */
function kept(table, value, wanted) {
    const text = JSON.stringify(value);
    for (let i = 1;; i++) {
        const name = i === 1 ? wanted : `${wanted}_${i}`, known = Object.hasOwn(table, name) ? table[name] : undefined;
        if (known === undefined)
            table[name] = value;
        if (known === undefined || JSON.stringify(known) === text)
            return name;
    }
}
