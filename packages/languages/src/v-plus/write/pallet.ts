import { compose, millimetres, palletPitch, rotate, type Pallet, type Vector3 } from "@twincell/core";
import { singleText } from "../../parser/index.ts";
import { transText } from "./location.ts";
import type { WalkedPlace } from "../../emitter/index.ts";

/**
 * Variables of a pallet: the place being visited, the first place, and the counters of layer, outer and inner loop, and
 * of the way along a row.
 */
export interface PalletNames {
  readonly place: string;
  readonly first: string;
  readonly layer: string;
  readonly outer: string;
  readonly inner: string;
  readonly along: string;
}

/**
 * A pallet as loops: every line before the steps that are done at a place. The first place and the pitches are written
 * in the world of the controller; SHIFT moves along its axes.
 */
export function palletLines(pallet: Pallet, names: PalletNames, place: WalkedPlace): string[] {
  const { layer, outer, inner, along } = names;
  const shifted = pallet.interleave === "odd-rows-shifted";
  const order = pallet.order ?? "rows";
  const byRows = order.startsWith("rows");
  const zigzag = order.endsWith("zigzag");
  const vendorFromFrame = compose(place.vendorFromWorld, place.worldFromFrame(pallet.frame));
  const pitch = palletPitch(pallet);
  const turned = (p: Vector3): Vector3 => rotate(vendorFromFrame.quaternion, p, [0, 0, 0]);
  const byColumn = turned(pitch.column);
  const byRow = turned(pitch.row);
  const byLayer = turned(pitch.layer);
  const last = (byRows ? pallet.columns : pallet.rows) - 1;
  const way = zigzag || shifted ? along : inner;
  const [column, row] = byRows ? [way, outer] : [outer, way];
  const sum = (i: 0 | 1 | 2): string =>
    `${column}*${factor(byColumn[i])}+${row}*${factor(byRow[i])}+${layer}*${factor(byLayer[i])}`;
  return [
    `SET ${names.first} = ${transText(compose(vendorFromFrame, pallet.origin))}`,
    `FOR ${layer} = 0 TO ${pallet.layers - 1}`,
    `FOR ${outer} = 0 TO ${(byRows ? pallet.rows : pallet.columns) - 1}`,
    `FOR ${inner} = 0 TO ${last}${shifted ? `-(${outer} MOD 2)` : ""}`,
    ...(zigzag
      ? [`${along} = ${inner}+(${outer} MOD 2)*(${last - (shifted ? 1 : 0)}-2*${inner})`]
      : shifted
        ? [`${along} = ${inner}`]
        : []),
    ...(shifted ? [`${along} = ${along}+0.5*(${outer} MOD 2)`] : []),
    `SET ${names.place} = SHIFT(${names.first} BY ${sum(0)}, ${sum(1)}, ${sum(2)})`,
  ];
}

/** A number behind a sign of multiplication. */
function factor(length_m: number): string {
  const mm = millimetres(length_m);
  const text = singleText(Math.abs(mm) < 1e-6 ? 0 : mm);
  return text.startsWith("-") ? `(${text})` : text;
}
