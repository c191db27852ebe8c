import { degrees, toVal3 } from "@twincell/core";
import { Names, fixed } from "../../writing/index.ts";
/** A tenth of a micrometre, a hundred-thousandth of a degree. */
const MM = 4, DEG = 5;
/** Names that every version of the controller takes. */
const NAME_LENGTH = 15;
export const RESERVED = new Set([
    "begin", "end", "if", "else", "elseif", "endif", "while", "endwhile", "for", "to", "step", "endfor", "do", "until", "switch", "case", "default", "break", "endswitch", "call", "return", "and", "or", "xor", "not",
    "true", "false", "start", "stop", "world", "flange", "gripper", "num", "bool", "string", "dio", "aio", "sio", "frame", "tool", "point", "joint", "trsf", "mdesc", "config", "pi", "x", "y", "z", "rx", "ry", "rz",
    "open", "close", "delay", "wait", "watch", "here", "appro", "compose", "movej", "movel", "movec", "abs", "sqrt", "sin", "cos", "tan", "min", "max", "size", "put", "putln", "cls",
]);
export const attributes = (pairs) => pairs.map(([name, value]) => ` ${name}="${value}"`).join("");
const NAMES = ["x", "y", "z", "rx", "ry", "rz"];
/** x, y, z [mm], rx, ry, rz [deg], R = Rx(rx)·Ry(ry)·Rz(rz). */
export function sixOf({ position, quaternion }) {
    return [...position.map(v => fixed(v * 1000, MM)), ...toVal3(quaternion).map(angle => { const text = fixed(angle, DEG); return text === "-180" ? "180" : text; })];
}
export const trsfAttributes = (pose) => attributes(sixOf(pose).map((text, i) => [NAMES[i], text]));
export const jointAttributes = (q_rad) => attributes(Array.from(q_rad, (q, i) => [`j${i + 1}`, fixed(degrees(q), DEG)]));
/** The data of an application, in the order in which the program first needs them. */
export class DataList {
    names = new Names({ most: NAME_LENGTH, reserved: RESERVED, first: "n_", foldsCase: true });
    data = new Map();
    add(name, type, value, step) {
        if (!this.data.has(name))
            this.data.set(name, { name, type, value, step });
        return name;
    }
    get all() { return [...this.data.values()]; }
}
