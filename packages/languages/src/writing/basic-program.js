import { compose, identity, rotate } from "@twincell/core";
import { asciiText } from "../text/index.ts";
import { CannotSay, called } from "./cannot.ts";
import { patternOf, pitchTerm } from "./pattern.ts";
import { BlockStepWriter } from "./steps.ts";
/** Writes the steps of a program as a BASIC: blocks, loops, patterns and remarks; what instructions look like is the language's own affair. */
export class BasicProgram extends BlockStepWriter {
    names;
    words;
    said = new Map();
    constructor(place, names, words) {
        super(place);
        this.names = names;
        this.words = words;
    }
    begin() {
        super.begin();
        this.said.clear();
    }
    /** Says a setting where it is not the one that holds. */
    say(sort, line, add) {
        if (this.said.get(sort) !== line)
            add(line);
        this.said.set(sort, line);
    }
    remark(text, step) { this.out.add(`'${text}`, step); }
    step(step, next) {
        const add = line => { this.out.add(line, step.id); };
        switch (step.type) {
            case "move": return this.move(step, next, add);
            case "wait": return this.wait(step.s, add);
            case "gripper": return this.grip(step.closed, add);
            case "set": {
                if (this.place.program.signals[step.signal]?.kind !== "digital-out" || typeof step.to !== "boolean")
                    throw new CannotSay(step.id, `${called(step)} writes ${String(step.to)} to the line ${step.signal}, which is no digital output.`, "Choose a digital output.");
                return this.set(step, this.line(step.signal, step), add);
            }
            case "wait-for": return this.waitFor(this.condition(step.when, step), step, add);
            case "payload": return this.payload(step, add);
            case "message": return this.message(asciiText(step.text).replace(/"/g, "'"), add);
            case "stop": return this.stop(add);
            case "comment": return add(`'- ${asciiText(step.text)}`.trimEnd());
            case "call":
                this.call(step.routine, add);
                return this.begin();
            case "repeat": {
                if (step.times === "forever")
                    return this.loop(...this.words.forever, step);
                const variable = this.counter("count");
                return this.loop(`For ${variable} = 1 To ${step.times}`, `Next ${variable}`, step);
            }
            case "if": return this.choice(step, `If ${this.condition(step.when, step)} Then`, "Else", this.words.endIf);
            case "pallet": return this.pallet(step);
        }
    }
    /** Says what must hold before the loops over a pattern. */
    beforePattern(_step) { }
    condition(when, step) {
        if (!("is" in when))
            throw new CannotSay(step.id, `${called(step)} compares the line ${when.signal} with a number.`, "Decide by a digital line.");
        return this.asked(when, this.line(when.signal, step));
    }
    /** A loop over layers, lines and places; the place changes with them. A pallet of the world is counted in the base of the robot, which turns its pitches. */
    pallet(step) {
        this.beforePattern(step);
        const { out, place: { baseFromWorld, program }, words: { endIf, mm } } = this;
        const pattern = patternOf(step, program, (v, { frame }) => frame === "world" ? rotate(baseFromWorld.quaternion, v) : v), { pallet, lines, inLine, isShifted } = pattern;
        const [layer, line, along, at] = [this.counter("layer"), this.counter("line"), this.counter("along"), this.counter("at")];
        const loop = (variable, last, inside) => { out.block(`For ${variable} = 0 To ${last}`, `Next ${variable}`, step.id, inside); };
        const add = text => { out.add(text, step.id); }, odd = isShifted ? inLine - 1 : inLine;
        const visit = () => {
            add(`${at} = ${along}`);
            if (pattern.isZigzag && odd > 1)
                out.block(`If ${line} Mod 2 = 1 Then`, endIf, step.id, () => { add(`${at} = ${odd - 1} - ${along}`); });
            const origin = pallet.frame === "world" ? compose(baseFromWorld, pallet.origin) : pallet.origin, from = isShifted ? `(${at} + (${line} Mod 2) / 2)` : at;
            const term = (i) => (by, factor) => pitchTerm(by[i], factor, mm, " ");
            const coordinates = [0, 1, 2].map(i => `${mm(origin.position[i])}${term(i)(pattern.along_m, from)}${term(i)(pattern.away_m, line)}${term(i)(pattern.up_m, layer)}`);
            this.palletPlace(step, pallet, coordinates, origin.quaternion, add);
            this.inside(step.steps, step.id);
        };
        loop(layer, `${pallet.layers - 1}`, () => { loop(line, `${lines - 1}`, () => { loop(along, isShifted ? `${inLine - 1} - ${line} Mod 2` : `${inLine - 1}`, visit); }); });
        this.begin();
    }
    /** The pose of a target in the base, where it counts in the world. */
    inBase({ pose, frame }) {
        return frame === "world" ? compose(this.place.baseFromWorld, compose(identity(), pose)) : pose;
    }
}
export function inUse({ steps, routines, pallets: known }) {
    const tools = new Set(), frames = new Set(), pallets = new Set(), signals = new Map();
    const frame = (name) => { if (name !== "world" && !Object.hasOwn(known, name))
        frames.add(name); };
    const look = (list) => {
        for (const step of list) {
            const signal = step.type === "set" ? step.signal : step.type === "wait-for" || step.type === "if" ? step.when.signal : undefined;
            if (signal !== undefined && !signals.has(signal))
                signals.set(signal, step);
            if (step.type === "move") {
                for (const target of step.via === undefined ? [step.target] : [step.via, step.target]) {
                    if (target.tool !== undefined && target.tool !== "flange")
                        tools.add(target.tool);
                    if ("pose" in target)
                        frame(target.frame);
                }
            }
            if (step.type === "pallet" && Object.hasOwn(known, step.pallet)) {
                pallets.add(step.pallet);
                frame(known[step.pallet].frame);
            }
            if (step.type === "if") {
                look(step.then);
                look(step.else ?? []);
            }
            if (step.type === "repeat" || step.type === "pallet")
                look(step.steps);
        }
    };
    for (const list of [steps, ...Object.values(routines)])
        look(list);
    return { tools, frames, pallets, signals };
}
