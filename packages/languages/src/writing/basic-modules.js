import { everyStep } from "@twincell/core";
import { asciiText } from "../text/index.ts";
import { BasicProgram, inUse } from "./basic-program.ts";
import { CannotSay, called } from "./cannot.ts";
import { Names } from "./names.ts";
import { BlockWriter } from "./text-writer.ts";
export class BasicModules extends BasicProgram {
    used;
    numbers = new Map();
    declared = [];
    constructor(place, names, words) {
        super(place, new Names(names), words);
        this.used = inUse(place.program);
    }
    write() {
        const { program, robot } = this.place, { main, open, close, file } = this.words, whole = new BlockWriter();
        for (const line of [...this.head(), ...this.constants()])
            whole.add(line);
        for (const [name, steps] of [[main, program.steps], ...Object.entries(program.routines).map(([routine, list]) => [this.named("routine", routine), list])]) {
            const inside = this.out = new BlockWriter();
            this.declared = [];
            this.begin();
            if (name === main)
                for (const line of this.beginning())
                    inside.add(line);
            this.steps(steps);
            if (name === main)
                for (const line of this.ending())
                    inside.add(line);
            whole.block(open(name), close, "", () => {
                if (name === main) {
                    whole.add(`'* ${asciiText(program.name)}`.trimEnd());
                    whole.add(`'* ${asciiText(robot.name)}. Lengths in mm, angles in degrees, places in the base of the robot.`);
                }
                if (this.declared.length > 0)
                    for (const line of this.declaration(this.declared))
                        whole.add(line);
                whole.append(inside);
            });
        }
        return whole.file(file, "\r\n");
    }
    named(sort, name) { return this.names.of(sort, name.toLowerCase()); }
    line(signal) { return this.named("signal", signal); }
    /** The number of a frame; 0 for the base. */
    numberOf(frame) { return this.numbers.get(`frame\0${frame}`) ?? 0; }
    call(routine, add) { add(`Call ${this.named("routine", routine)}`); }
    counter(name) {
        const variable = this.names.fresh(name);
        this.introduce(variable);
        return variable;
    }
    /** A variable that the routine which is written uses. */
    introduce(variable) { if (!this.declared.includes(variable))
        this.declared.push(variable); }
    constants() {
        const { tools, frames, signals } = this.used, { most, define, gripper } = this.words, lines = [];
        for (const [sort, names, limit, what] of [["tool", tools, most.tools, "tools"], ["frame", frames, most.frames, most.called]]) {
            if (names.size > limit)
                throw new CannotSay("", `The program uses ${names.size} ${what}; a controller keeps ${limit}.`, "Divide the program.");
            for (const [i, name] of [...names].entries()) {
                this.numbers.set(`${sort}\0${name}`, i + 1);
                lines.push(`${define} ${this.named(sort, name)} ${i + 1}`);
            }
        }
        lines.push(...this.patterns());
        const taken = new Map();
        for (const [signal, step] of signals) {
            const address = this.address(signal, step), key = this.sharesNumbers ? address : address + (this.place.program.signals[signal].kind === "digital-in" ? 0.5 : 0), other = taken.get(key);
            if (other !== undefined)
                throw new CannotSay(step.id, `${called(step)} uses the line ${signal} with the number ${address}, which ${other} has.`, "Give every line a number of its own.");
            taken.set(key, signal);
            lines.push(`${define} ${this.line(signal)} ${address}`);
        }
        if (Array.from(everyStep(this.place.program)).some(({ type }) => type === "gripper"))
            lines.push(`${define} ${gripper.name} ${gripper.output}`);
        return lines;
    }
    address(signal, step) {
        const { signals } = this.place.program, line = Object.hasOwn(signals, signal) ? signals[signal] : undefined, { language, lines: [first, last], gripper } = this.words;
        if (line?.address === undefined)
            throw new CannotSay(step.id, `${called(step)} uses the line ${signal}, whose number is not known.`, "Give the line its number in the list of signals.");
        if (!Number.isInteger(line.address) || line.address < first || line.address > last)
            throw new CannotSay(step.id, `${called(step)} uses the line ${signal} with the number ${line.address}; ${language} counts lines from ${first} to ${last}.`, "Give the line a number of the controller.");
        if ((line.kind === "digital-out" || this.sharesNumbers) && line.address === gripper.output)
            throw new CannotSay(step.id, `${called(step)} uses the output ${gripper.output}, which is the gripper's.`, "Give the line another number.");
        return line.address;
    }
}
