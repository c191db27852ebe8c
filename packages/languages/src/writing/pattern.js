import { palletPitch } from "@twincell/core";
import { CannotSay, called } from "./cannot.ts";
/**
 * @param seen  how a direction of the pallet's frame looks where the text counts.
 * @throws {CannotSay} for a pallet that is not there, and for an order that no plain loop visits.
 */
export function patternOf(step, { pallets }, seen = direction => direction) {
    const pallet = Object.hasOwn(pallets, step.pallet) ? pallets[step.pallet] : undefined;
    if (pallet === undefined)
        throw new CannotSay(step.id, `${called(step)} works on the pallet ${step.pallet}, which the program does not have.`, "Choose another pallet.");
    const order = pallet.order ?? "rows", byRows = order.startsWith("rows"), isShifted = pallet.interleave === "odd-rows-shifted" && pallet.rows > 1;
    if (isShifted && !byRows)
        throw new CannotSay(step.id, `${called(step)} visits the interleaved pallet ${step.pallet} by columns, which no plain loop does.`, "Visit it by rows.");
    const lines = byRows ? pallet.rows : pallet.columns, inLine = byRows ? pallet.columns : pallet.rows, pitch = palletPitch(pallet);
    return {
        pallet, lines, inLine, isShifted, isZigzag: order.endsWith("zigzag") && lines > 1 && inLine > 1,
        along_m: seen(byRows ? pitch.column : pitch.row, pallet), away_m: seen(byRows ? pitch.row : pitch.column, pallet), up_m: seen(pallet.layers > 1 ? pitch.layer : [0, 0, 0], pallet),
    };
}
/**
 * A pitch times its counter, as a term of a sum with its sign; nothing for a pitch of no length.
 *
 * @param written  the length of a pitch in the language, without a sign.
 */
export function pitchTerm(pitch_m, factor, written, blank = "") {
    const length = written(Math.abs(pitch_m));
    return length === "0" ? "" : `${blank}${pitch_m < 0 ? "-" : "+"}${blank}${length}${blank}*${blank}${factor}`;
}
