import { TextError } from "../../text/index.ts";
import { bool, real } from "./values.ts";
const WIRES = { $IN: "in", $OUT: "out", $ANIN: "analogue-in", $ANOUT: "analogue-out" };
const KEY = /^(\$(?:IN|OUT|ANIN|ANOUT))\[([0-9]+)\]$/;
/** The output that a gripper hangs on is called so; TRUE closes (row T-31). */
const GRIPPER = "GRIPPER";
const CALLED = { in: "in", out: "out", "analogue-in": "anin", "analogue-out": "anout" };
const KINDS = { in: "digital-in", out: "digital-out", "analogue-in": "analogue-in", "analogue-out": "analogue-out" };
/** The lines in and out: declared with a name (`SIGNAL PART $IN[3]`), or met by their number. */
export class Lines {
    met;
    /** Whether something outside was asked for, which may change by itself. */
    asked = false;
    outside;
    byName = new Map();
    written = new Map();
    /** @param met  receives the lines that are used, by name. */
    constructor(declared, outside, met) {
        this.outside = outside;
        this.met = met;
        for (const { name, wire, address } of declared) {
            const line = { name: name.toLowerCase(), wire, address };
            this.byName.set(name, line);
            this.byName.set(`${wire} ${address}`, line);
        }
    }
    /** The line of a name or of `$IN[3]`, or undefined when it is none. */
    line(key) {
        const named = this.byName.get(key);
        if (named !== undefined)
            return this.note(named);
        const match = KEY.exec(key);
        if (match === null)
            return undefined;
        const wire = WIRES[match[1]], address = Number(match[2]);
        return this.note(this.byName.get(`${wire} ${address}`) ?? { name: `${CALLED[wire]}_${address}`, wire, address });
    }
    isGripper({ name }) { return name.toUpperCase() === GRIPPER; }
    read(line) {
        const known = this.written.get(line.name);
        if (known === undefined || line.wire === "in" || line.wire === "analogue-in")
            this.asked = true;
        const value = line.wire === "out" || line.wire === "analogue-out" ? known ?? this.outside?.read(line.name) : this.outside?.read(line.name);
        return line.wire.startsWith("analogue") ? real(Number(value ?? 0)) : bool(value === true);
    }
    write(line, value) { this.written.set(line.name, value); }
    note(line) {
        if (!this.isGripper(line))
            this.met[line.name] ??= { kind: KINDS[line.wire], address: line.address };
        return line;
    }
    /** What the program waits for, when it is one line: `X`, `NOT X`, `X == TRUE`, `X > 0.5`. */
    condition(of, keyOf, numberOf) {
        const refuse = (at) => { throw new TextError(at, "one line in or out, or its opposite", "The program waits for something that is not one line of the controller."); };
        const named = (variable) => {
            const line = variable.kind === "variable" ? this.line(keyOf(variable)) : undefined;
            return line ?? refuse(variable);
        };
        if (of.kind === "variable")
            return { signal: named(of).name, is: true };
        if (of.kind === "unary" && of.sign === "NOT") {
            const inner = this.condition(of.of, keyOf, numberOf);
            return "is" in inner ? { ...inner, is: !inner.is } : refuse(of);
        }
        if (of.kind !== "binary")
            return refuse(of);
        const { sign, left, right } = of;
        if ((sign === "==" || sign === "<>") && right.kind === "bool")
            return { signal: named(left).name, is: right.value === (sign === "==") };
        if (sign === ">" || sign === ">=")
            return { signal: named(left).name, above: numberOf(right) };
        if (sign === "<" || sign === "<=")
            return { signal: named(left).name, below: numberOf(right) };
        return refuse(of);
    }
}
