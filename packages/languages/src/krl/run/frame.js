import { real, whole } from "./values.ts";
/** Axis values as a structure. */
export const axesOf = (axes_deg) => ({ kind: "structure", type: "E6AXIS", fields: new Map(axes_deg.map((value, i) => [`A${i + 1}`, real(value)])) });
/** A structure with one member changed, which may lie inside others. */
export function within(structure, [name, ...rest], value) {
    if (name === undefined)
        return structure;
    const inner = structure.fields.get(name);
    const changed = rest.length === 0 ? value : within(inner?.kind === "structure" ? inner : { kind: "structure", type: undefined, fields: new Map() }, rest, value);
    return { ...structure, fields: new Map(structure.fields).set(name, changed) };
}
/** A value as a variable of that type holds it. */
export function typed(value, type) {
    if (value.kind === "number" && type === "INT" && !value.whole)
        return whole(Math.round(value.value));
    if (value.kind === "number" && type === "REAL" && value.whole)
        return real(value.value);
    return value.kind === "structure" && value.type === undefined && type !== undefined ? { ...value, type } : value;
}
