import { TextError } from "../../text/index.ts";
/** The arguments of one call: by place, or by name as in `r=0.01`. */
export class Arguments {
    at;
    name;
    args;
    free;
    evaluate;
    constructor(name, args, at, evaluate) {
        this.name = name;
        this.args = args;
        this.free = args.filter(argument => argument.name === undefined);
        this.at = at;
        this.evaluate = evaluate;
    }
    find(place, name) {
        return (this.args.find(argument => argument.name === name) ?? this.free[place])?.value;
    }
    /** The argument as it is written. */
    given(place, name) {
        const found = this.find(place, name);
        if (found === undefined)
            throw new TextError(this.at, `the argument ${name}`, `${this.name} is called without its argument ${name}.`);
        return found;
    }
    required(place, name) { return this.evaluate(this.given(place, name)); }
    optional(place, name) {
        const found = this.find(place, name);
        return found === undefined ? undefined : this.evaluate(found);
    }
    all() { return this.args.flatMap(({ value }) => value === undefined ? [] : [this.evaluate(value)]); }
    count(least, most) {
        const count = this.args.length;
        if (count >= least && count <= most)
            return;
        const wanted = least === most ? `${most}` : `${least} to ${most}`;
        throw new TextError(this.at, `${wanted} argument${most === 1 ? "" : "s"}`, `${this.name} takes ${wanted} argument${most === 1 ? "" : "s"}; ${count} are given.`);
    }
}
