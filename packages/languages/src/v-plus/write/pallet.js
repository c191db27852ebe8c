import { compose, inverse, millimetres, palletPitch, rotate } from "@twincell/core";
import { singleText } from "../../text/index.ts";
import { transText } from "./location.ts";
/**
 * A pallet as loops: every line before the steps that are done at a place. The first place and the pitches are written in
 * the world of the controller; SHIFT moves along its axes.
 */
export function palletLines(pallet, names, place) {
    const { layer, outer, inner, along } = names, shifted = pallet.interleave === "odd-rows-shifted";
    const order = pallet.order ?? "rows", byRows = order.startsWith("rows"), zigzag = order.endsWith("zigzag");
    const vendorFromFrame = compose(inverse(compose(place.worldFromBase, place.robot.baseFromVendorWorld)), place.frames[pallet.frame] ?? { position: [0, 0, 0], quaternion: [0, 0, 0, 1] });
    const pitch = palletPitch(pallet), turned = (p) => rotate(vendorFromFrame.quaternion, p, [0, 0, 0]);
    const byColumn = turned(pitch.column), byRow = turned(pitch.row), byLayer = turned(pitch.layer);
    const last = (byRows ? pallet.columns : pallet.rows) - 1, way = zigzag || shifted ? along : inner;
    const [column, row] = byRows ? [way, outer] : [outer, way];
    const sum = (i) => `${column}*${factor(byColumn[i])}+${row}*${factor(byRow[i])}+${layer}*${factor(byLayer[i])}`;
    return [
        `SET ${names.first} = ${transText(compose(vendorFromFrame, pallet.origin))}`,
        `FOR ${layer} = 0 TO ${pallet.layers - 1}`,
        `FOR ${outer} = 0 TO ${(byRows ? pallet.rows : pallet.columns) - 1}`,
        `FOR ${inner} = 0 TO ${last}${shifted ? `-(${outer} MOD 2)` : ""}`,
        ...(zigzag ? [`${along} = ${inner}+(${outer} MOD 2)*(${last - (shifted ? 1 : 0)}-2*${inner})`] : shifted ? [`${along} = ${inner}`] : []),
        ...(shifted ? [`${along} = ${along}+0.5*(${outer} MOD 2)`] : []),
        `SET ${names.place} = SHIFT(${names.first} BY ${sum(0)}, ${sum(1)}, ${sum(2)})`,
    ];
}
/** A number behind a sign of multiplication. */
function factor(length_m) {
    const mm = millimetres(length_m), text = singleText(Math.abs(mm) < 1e-6 ? 0 : mm);
    return text.startsWith("-") ? `(${text})` : text;
}
