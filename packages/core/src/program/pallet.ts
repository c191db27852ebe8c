import type { Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** In which order the places of a layer are visited. A zigzag turns round at the end of each line. */
export const PALLET_ORDERS = ["rows", "columns", "rows-zigzag", "columns-zigzag"] as const;
export type PalletOrder = (typeof PALLET_ORDERS)[number];
export const PALLET_PATTERNS = ["none", "odd-rows-shifted"] as const;

/** A pattern of places, taught by three corner points; the angle between its rows and columns need not be 90°. */
export interface Pallet {
  /** Name of the frame that the points are in. */
  readonly frame: string;
  /** Place 1. Every other place is turned the same way. */
  readonly origin: Pose<"frame", "place">;
  /** Where the first row ends: its last column [m]. */
  readonly rowEnd: Vector3;
  /** Where the first column ends: its last row [m]. */
  readonly columnEnd: Vector3;
  readonly rows: number;
  readonly columns: number;
  readonly layers: number;
  /** From one layer to the next along z of the frame; negative stacks downwards. */
  readonly layer_m: number;
  /**
   * "odd-rows-shifted": every second row stands half a pitch further and has one place fewer, as bottles are packed.
   */
  readonly interleave?: (typeof PALLET_PATTERNS)[number];
  /** "rows" by default: along the first row, then the next. */
  readonly order?: PalletOrder;
}

/**
 * How far one place is from the next along a row, along a column and from layer to layer [m, in the pallet's frame].
 */
export interface PalletPitch {
  readonly column: Vector3;
  readonly row: Vector3;
  readonly layer: Vector3;
}

/** A direction with one place only has no pitch, whatever its corner says. */
export function palletPitch({ origin, rowEnd, columnEnd, rows, columns, layer_m }: Pallet): PalletPitch {
  const part = (end: Vector3, count: number): Vector3 =>
    count < 2
      ? [0, 0, 0]
      : [
          (end[0] - origin.position[0]) / (count - 1),
          (end[1] - origin.position[1]) / (count - 1),
          (end[2] - origin.position[2]) / (count - 1),
        ];
  return { column: part(rowEnd, columns), row: part(columnEnd, rows), layer: [0, 0, layer_m] };
}

/** Which place it is, each counted from 0. */
export interface PalletIndex {
  readonly layer: number;
  readonly row: number;
  readonly column: number;
}

/** Places in that row. */
export const columnsOfRow = ({ columns, interleave }: Pick<Pallet, "columns" | "interleave">, row: number): number =>
  interleave === "odd-rows-shifted" && row % 2 === 1 ? columns - 1 : columns;

export function palletCount(pallet: Pallet): number {
  let perLayer = 0;
  for (let row = 0; row < pallet.rows; row++) perLayer += columnsOfRow(pallet, row);
  return perLayer * pallet.layers;
}

/** The places in the order in which they are visited, layer by layer. */
export function* palletIndices(pallet: Pallet): Generator<PalletIndex, void> {
  const order = pallet.order ?? "rows";
  const zigzag = order.endsWith("zigzag");
  const byRows = order.startsWith("rows");
  for (let layer = 0; layer < pallet.layers; layer++) {
    for (let line = 0; line < (byRows ? pallet.rows : pallet.columns); line++) {
      const count = byRows ? columnsOfRow(pallet, line) : pallet.rows;
      for (let i = 0; i < count; i++) {
        const along = zigzag && line % 2 === 1 ? count - 1 - i : i;
        const row = byRows ? line : along;
        const column = byRows ? along : line;
        if (column < columnsOfRow(pallet, row)) yield { layer, row, column };
      }
    }
  }
}

/**
 * Where that place is:
 *
 *   p = origin + (column + s) · pitch_column + row · pitch_row + layer · pitch_layer,   s = ½ in shifted rows, else 0
 */
export function palletSlot(
  pallet: Pallet,
  { layer, row, column }: PalletIndex,
  pitch: PalletPitch = palletPitch(pallet),
): Pose<"frame", "place"> {
  const {
    position: [x, y, z],
    quaternion,
  } = pallet.origin;
  const along = column + (pallet.interleave === "odd-rows-shifted" && row % 2 === 1 ? 0.5 : 0);
  return {
    position: [
      x + along * pitch.column[0] + row * pitch.row[0] + layer * pitch.layer[0],
      y + along * pitch.column[1] + row * pitch.row[1] + layer * pitch.layer[1],
      z + along * pitch.column[2] + row * pitch.row[2] + layer * pitch.layer[2],
    ],
    quaternion: [...quaternion],
  };
}

/** Every place of the pattern, in the order in which they are visited. */
export function palletSlots(pallet: Pallet): Pose<"frame", "place">[] {
  const pitch = palletPitch(pallet);
  return Array.from(palletIndices(pallet), index => palletSlot(pallet, index, pitch));
}
