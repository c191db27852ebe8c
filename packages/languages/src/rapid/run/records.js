import { TextError } from "../../text/index.ts";
import { times, turned } from "./frame.ts";
import { NOTHING_KG } from "./predefined.ts";
import { asFrame, asNumber, asNumbers, asPosition, asRecord } from "./values.ts";
/** A load is given in the tool; the step counts from the flange. */
export function loadOf(load, tool, at) {
    const [mass, cog, aom, ix, iy, iz] = asRecord(load, at, 6, "a load"), flange = times(tool, { mm: asPosition(cog, at), wxyz: [1, 0, 0, 0] }).mm;
    const inertia = [ix, iy, iz].map(each => asNumber(each, at)), axes = times(tool, asFrame([[0, 0, 0], aom], at)).wxyz;
    if (asNumber(mass, at) <= NOTHING_KG)
        return { mass_kg: 0, center_m: [0, 0, 0] };
    const base = { mass_kg: asNumber(mass, at), center_m: [flange[0] / 1000, flange[1] / 1000, flange[2] / 1000] };
    if (inertia.every(each => each === 0))
        return base;
    // I = Σ I_k a_k a_kᵀ over the axes of moment.
    const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(axis => turned(axes, [...axis])), entry = (i, j) => columns.reduce((sum, axis, k) => sum + inertia[k] * axis[i] * axis[j], 0);
    return { ...base, inertia_kgm2: [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)] };
}
/** How far before its end a move turns into the next one [m]; `own_mm` is what \\Z says instead. */
export function zoneOf(zone, own_mm, at) {
    const [isStop, radius] = asRecord(zone, at, 7, "a zone");
    const zone_mm = own_mm ?? asNumber(radius, at);
    if (!(zone_mm >= 0))
        throw new TextError(at, "a zone of 0 mm or more", `The zone is ${zone_mm} mm.`);
    return isStop === true ? 0 : zone_mm / 1000;
}
export function toolFrameOf(value, at) {
    const [holds, frame] = asRecord(value, at, 3, "a tool");
    if (holds !== true)
        throw new TextError(at, "a tool that the robot holds", "Tools that stand still are not executed here.");
    return asFrame(frame, at);
}
export function jointsOf(value, at) {
    const [robax] = asRecord(value, at, 2, "a jointtarget [[…],[…]]");
    return asNumbers(robax, at, 6, "six joint angles");
}
