import { TextError } from "../faults.ts";
const SORTS = { place: "a place", joints: "a set of joint angles", shift: "a step from a place" };
export const sortOf = (value) => typeof value === "number" ? "a number" : typeof value === "string" ? "a text" : SORTS[value.kind];
const instead = (value, wanted, at) => new TextError(at, wanted, `${sortOf(value).replace(/^./, letter => letter.toUpperCase())} stands where ${wanted} is expected.`);
export function numberIn(value, at) {
    if (typeof value !== "number")
        throw instead(value, "a number", at);
    return value;
}
export function placeIn(value, at) {
    if (typeof value !== "object" || value.kind !== "place")
        throw instead(value, "a place", at);
    return value;
}
/** A number between these, or a fault at its place. */
export function between(value, least, most, what, at) {
    if (value >= least && value <= most)
        return value;
    throw new TextError(at, `${what} from ${least} to ${most}`, `${what.replace(/^./, letter => letter.toUpperCase())} is ${value}.`);
}
/** Signs between two numbers, or two texts. */
export function arithmetic(sign, left, right, truth, at) {
    if (typeof left === "string" && typeof right === "string") {
        if (sign === "+")
            return left + right;
        if (sign === "=" || sign === "<>")
            return truth((left === right) === (sign === "="));
        throw new TextError(at, "+, = or <>", `"${sign}" does not join two texts.`);
    }
    const a = numberIn(left, at), b = numberIn(right, at);
    if ((sign === "/" || sign === "mod") && b === 0)
        throw new TextError(at, "a divisor other than 0", "The divisor is 0.");
    const value = NUMBERS[sign]?.(a, b);
    if (value === undefined)
        throw new TextError(at, "an operator", `"${sign}" is no operator.`);
    if (typeof value === "boolean")
        return truth(value);
    if (!Number.isFinite(value))
        throw new TextError(at, "a finite result", "The result is not a number.");
    return value;
}
const NUMBERS = {
    "+": (a, b) => a + b, "-": (a, b) => a - b, "*": (a, b) => a * b, "/": (a, b) => a / b, "^": (a, b) => a ** b, mod: (a, b) => a % b,
    "=": (a, b) => a === b, "==": (a, b) => a === b, "<>": (a, b) => a !== b, "><": (a, b) => a !== b, "<": (a, b) => a < b, ">": (a, b) => a > b, "<=": (a, b) => a <= b, ">=": (a, b) => a >= b,
    and: (a, b) => a !== 0 && b !== 0, or: (a, b) => a !== 0 || b !== 0, xor: (a, b) => (a !== 0) !== (b !== 0),
};
