import { TextError } from "../../text/index.ts";
import { asNumber } from "./values.ts";
/** The arguments of one instruction: some by place, optional ones by name. */
export class Arguments {
    at;
    name;
    args;
    free;
    evaluate;
    constructor(name, args, at, evaluate) {
        this.name = name;
        this.args = args;
        this.free = args.flatMap(argument => argument.name === undefined && argument.value !== undefined ? [argument.value] : []);
        this.at = at;
        this.evaluate = evaluate;
    }
    /** The argument at that place, as it is written. */
    given(place, what) {
        const found = this.free[place];
        if (found === undefined)
            throw new TextError(this.at, what, `${this.name} has no ${what}.`);
        return found;
    }
    value(place, what) { return this.evaluate(this.given(place, what)); }
    number(place, what) { return asNumber(this.value(place, what), this.given(place, what)); }
    /** The name of a line, a tool or a work object. */
    nameOf(place, what) {
        const found = this.given(place, what);
        if (found.kind !== "variable")
            throw new TextError(found, what, `${this.name} takes the name of ${what} here.`);
        return found.name;
    }
    has(name) { return this.args.some(argument => argument.name === name); }
    optionGiven(name) { return this.args.find(argument => argument.name === name)?.value; }
    option(name) {
        const found = this.optionGiven(name);
        return found === undefined ? undefined : asNumber(this.evaluate(found), found);
    }
    get count() { return this.free.length; }
    values() { return this.free.map(each => this.evaluate(each)); }
    options() { return new Map(this.args.flatMap(({ name, value }) => name === undefined ? [] : [[name, value === undefined ? true : this.evaluate(value)]])); }
}
