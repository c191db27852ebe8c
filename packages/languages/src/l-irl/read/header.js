import { TextError } from "../../text/index.ts";
const UNITS_M = { MM: 1e-3, M: 1 }, UNITS_RAD = { DEG: Math.PI / 180, RAD: 1 };
const X = 0, Y = 1, Z = 2;
/** Axes of the three turns, each about the axis as the turns before have left it. */
const TURNS = { ZYX: [Z, Y, X], ZYZ: [Z, Y, Z], XYZ: [X, Y, Z] };
/** `POSES 1 MM DEG ZYX BASE` */
export function readHeader(cursor) {
    cursor.expect("POSES");
    const { here } = cursor, version = cursor.number("the version 1");
    if (version !== 1)
        throw new TextError(here, "the version 1", `The list is of version ${version}; version 1 is read.`);
    const length = cursor.oneOf(["MM", "M"]), angle = cursor.oneOf(["DEG", "RAD"]), turns = cursor.oneOf(["ZYX", "ZYZ", "XYZ"]), from = cursor.oneOf(["BASE", "WORLD"]);
    cursor.expectEnd();
    return { unit_m: UNITS_M[length], unit_rad: UNITS_RAD[angle], turns: TURNS[turns], from };
}
/**
 * Position and three turns, in the units of the header:  R = R1(a) · R2(b) · R3(c), each R of half its angle as
 * quaternion, multiplied out axis by axis.
 */
export function poseOf([x, y, z, ...angles], { unit_m, unit_rad, turns }) {
    let turned = [0, 0, 0, 1];
    for (const [i, axis] of turns.entries())
        turned = turnedAbout(turned, axis, angles[i] * unit_rad);
    return { position: [x * unit_m, y * unit_m, z * unit_m], quaternion: turned };
}
/** q · (sin(angle/2) e_axis, cos(angle/2)) */
function turnedAbout([x, y, z, w], axis, angle_rad) {
    const s = Math.sin(angle_rad / 2), c = Math.cos(angle_rad / 2), v = [x, y, z];
    const next = (axis + 1) % 3, last = (axis + 2) % 3;
    const out = [0, 0, 0, w * c - v[axis] * s];
    out[axis] = v[axis] * c + w * s;
    out[next] = v[next] * c + v[last] * s;
    out[last] = v[last] * c - v[next] * s;
    return out;
}
