import { palletPitch, type Pallet, type PalletStep, type Program, type Vector3 } from "@twincell/core";
import { UnsupportedStep, called } from "./cannot.ts";

/** A pallet as loops over layers, lines and places visit it. */
export interface Pattern {
  readonly pallet: Pallet;
  readonly lines: number;
  readonly inLine: number;
  /** Every second line is one place shorter and half a pitch further. */
  readonly isShifted: boolean;
  /** Every second line is visited from its end. */
  readonly isZigzag: boolean;
  /** From place to place, from line to line, from layer to layer [m], as `seen` turned them. */
  readonly along_m: Vector3;
  readonly away_m: Vector3;
  readonly up_m: Vector3;
}

/**
 * @param seen  how a direction of the pallet's frame looks where the text counts.
 * @throws {UnsupportedStep} for a pallet that is not there, and for an order that no plain loop visits.
 */
export function patternOf(
  step: PalletStep,
  { pallets }: Program,
  seen: (direction: Vector3, pallet: Pallet) => Vector3 = direction => direction,
): Pattern {
  const pallet = Object.hasOwn(pallets, step.pallet) ? pallets[step.pallet] : undefined;
  if (pallet === undefined)
    throw new UnsupportedStep(
      step.id,
      `${called(step)} works on the pallet ${step.pallet}, which the program does not have.`,
      "Choose another pallet.",
    );
  const order = pallet.order ?? "rows";
  const byRows = order.startsWith("rows");
  const isShifted = pallet.interleave === "odd-rows-shifted" && pallet.rows > 1;
  if (isShifted && !byRows)
    throw new UnsupportedStep(
      step.id,
      `${called(step)} visits the interleaved pallet ${step.pallet} by columns, which no plain loop does.`,
      "Visit it by rows.",
    );
  const lines = byRows ? pallet.rows : pallet.columns;
  const inLine = byRows ? pallet.columns : pallet.rows;
  const pitch = palletPitch(pallet);
  return {
    pallet,
    lines,
    inLine,
    isShifted,
    isZigzag: order.endsWith("zigzag") && lines > 1 && inLine > 1,
    along_m: seen(byRows ? pitch.column : pitch.row, pallet),
    away_m: seen(byRows ? pitch.row : pitch.column, pallet),
    up_m: seen(pallet.layers > 1 ? pitch.layer : [0, 0, 0], pallet),
  };
}

/**
 * A pitch times its counter, as a term of a sum with its sign; nothing for a pitch of no length.
 *
 * @param written  the length of a pitch in the language, without a sign.
 */
export function pitchTerm(pitch_m: number, factor: string, written: (length_m: number) => string, blank = ""): string {
  const length = written(Math.abs(pitch_m));
  return length === "0" ? "" : `${blank}${pitch_m < 0 ? "-" : "+"}${blank}${length}${blank}*${blank}${factor}`;
}
