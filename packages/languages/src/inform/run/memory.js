import { TextError } from "../../text/index.ts";
/** Least and greatest value of a variable, by its letter; R is a real. */
const RANGES = { B: [0, 255], I: [-32768, 32767], D: [-2147483648, 2147483647] };
const KINDS = { IN: "digital-in", OT: "digital-out", AO: "analogue-out" };
/** Lines in and out by number, with the names that the steps know them by. */
const lineName = (wire, number) => `${wire.toLowerCase()}_${number}`;
/** Variables B, I, D, R and P, and the lines in and out. */
export class Memory {
    /** Whether something outside was asked for, which may change by itself. */
    asked = false;
    met;
    values = new Map();
    positions = new Map();
    outputs = new Map();
    outside;
    /** @param met  receives the lines that are used, by name. */
    constructor(outside, met) {
        this.outside = outside;
        this.met = met;
    }
    value(operand) {
        if (operand.kind === "number")
            return operand.value;
        if (operand.kind === "line")
            return this.line(operand) ? 1 : 0;
        return this.values.get(operand.name) ?? 0;
    }
    set(name, value, at) {
        const letter = name.replace(/^L/, "")[0], range = RANGES[letter];
        if (!Number.isFinite(value))
            throw new TextError(at, "a finite result", "The result is not a number.");
        const whole = range === undefined ? Math.fround(value) : Math.trunc(value);
        if (range !== undefined && (whole < range[0] || whole > range[1]))
            throw new TextError(at, `a number from ${range[0]} to ${range[1]}`, `${name} cannot hold ${whole}.`);
        this.values.set(name, whole);
    }
    /** Elements of a position variable: µm and 1/10000°. */
    position(name) {
        let values = this.positions.get(name);
        if (values === undefined)
            this.positions.set(name, values = [0, 0, 0, 0, 0, 0]);
        return values;
    }
    clear(name, count) {
        const stem = name.slice(0, -3), first = Number(name.slice(-3));
        if (name.startsWith("P")) {
            this.positions.delete(name);
            return;
        }
        for (const key of [...this.values.keys()])
            if (key.slice(0, -3) === stem && Number(key.slice(-3)) >= first && Number(key.slice(-3)) < first + count)
                this.values.delete(key);
    }
    write(number, to) {
        this.outputs.set(number, to);
        return this.note("OT", number);
    }
    note(wire, number) {
        const name = lineName(wire, number);
        this.met[name] ??= { kind: KINDS[wire], address: number };
        return name;
    }
    line({ wire, number }) {
        const name = this.note(wire, number), known = wire === "OT" ? this.outputs.get(number) : undefined;
        if (known === undefined)
            this.asked = true;
        return known ?? this.outside?.read(name) === true;
    }
    holds({ left, sign, right }, at) {
        const a = this.value(left), b = right === "ON" ? 1 : right === "OFF" ? 0 : this.value(right);
        switch (sign) {
            case "=": return a === b;
            case "<>": return a !== b;
            case "<": return a < b;
            case ">": return a > b;
            case "<=": return a <= b;
            case ">=": return a >= b;
            default: throw new TextError(at, "a comparison", "The condition compares nothing.");
        }
    }
    /** What is waited for, when it is one line that is on or off. */
    awaited({ left, sign, right }, at) {
        if (left.kind !== "line" || (right !== "ON" && right !== "OFF") || (sign !== "=" && sign !== "<>"))
            throw new TextError(at, "IN#(n)=ON or =OFF", "The job waits for something that is not one line of the controller.");
        return { signal: this.note(left.wire, left.number), is: (right === "ON") === (sign === "=") };
    }
}
/** Whether looking at a condition is looking at the outside, which stops the robot at its point. */
export const looksOutside = ({ left, right }) => left.kind === "line" || (typeof right === "object" && right.kind === "line");
