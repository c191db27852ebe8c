import { palletIndices, palletSlots, type Pallet, type Pose, type Vector3 } from "@twincell/core";

/** Places further apart than this are not the same [m]. */
const SAME_M = 2e-6;

/**
 * The pallet whose places these are, in their order; undefined when they are no pattern.
 *
 * @param lines  how many lines a layer has, and how many places the longest of them.
 */
export function fitPallet(
  places: readonly Pose[],
  frame: string,
  layers: number,
  lines: number,
  inLine: number,
): Pallet | undefined {
  const origin = places[0];
  if (origin === undefined || layers < 1 || lines < 1 || inLine < 1) return undefined;
  for (const interleave of ["none", "odd-rows-shifted"] as const) {
    for (const order of ["rows", "rows-zigzag", "columns", "columns-zigzag"] as const) {
      const byRows = order.startsWith("rows");
      const rows = byRows ? lines : inLine;
      const columns = byRows ? inLine : lines;
      if (interleave === "odd-rows-shifted" && (!byRows || rows < 2 || columns < 2)) continue;
      const pallet = palletOf(places, frame, origin, { rows, columns, layers, interleave, order });
      if (pallet !== undefined && meets(pallet, places)) return pallet;
    }
  }
  return undefined;
}

type Size = Pick<Pallet, "rows" | "columns" | "layers"> & Required<Pick<Pallet, "interleave" | "order">>;

/** The pallet of that size that these places would be; undefined where there are too few of them. */
function palletOf(places: readonly Pose[], frame: string, origin: Pose, size: Size): Pallet | undefined {
  const { rows, columns, layers, interleave, order } = size;
  const at = placeOf(places, size);
  const first = at(0, 0, 0);
  const rowEnd = columns > 1 ? at(0, 0, columns - 1) : first;
  const top = at(1, 0, 0);
  if (first === undefined || rowEnd === undefined) return undefined;
  const half = interleave === "odd-rows-shifted" && (rows - 1) % 2 === 1 ? 0.5 / (columns - 1) : 0;
  const last = rows > 1 ? at(0, rows - 1, 0) : first;
  if (last === undefined) return undefined;
  const columnEnd = [0, 1, 2].map(i => last[i]! - half * (rowEnd[i]! - first[i]!));
  return {
    frame,
    origin: { position: [...first], quaternion: [...origin.quaternion] },
    rowEnd: [...rowEnd],
    columnEnd: [columnEnd[0]!, columnEnd[1]!, columnEnd[2]!],
    rows,
    columns,
    layers,
    layer_m: top === undefined ? 0 : top[2] - first[2],
    ...(interleave === "none" ? {} : { interleave }),
    ...(order === "rows" ? {} : { order }),
  };
}

/** Where the place of that index lies among those that were visited in this order. */
function placeOf(
  places: readonly Pose[],
  size: Size,
): (layer: number, row: number, column: number) => Vector3 | undefined {
  const nowhere: Pose<"frame", "place"> = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
  const order = [
    ...palletIndices({ ...size, frame: "", origin: nowhere, rowEnd: [0, 0, 0], columnEnd: [0, 0, 0], layer_m: 0 }),
  ];
  return (layer, row, column) =>
    places[order.findIndex(index => index.layer === layer && index.row === row && index.column === column)]?.position;
}

function meets(pallet: Pallet, places: readonly Pose[]): boolean {
  const wanted = palletSlots(pallet);
  if (wanted.length !== places.length) return false;
  return wanted.every((place, i) => {
    const { position, quaternion } = places[i]!;
    const turned = Math.abs(place.quaternion.reduce((sum, value, k) => sum + value * quaternion[k]!, 0));
    return Math.hypot(...position.map((value, k) => value - place.position[k]!)) <= SAME_M && turned > 1 - 1e-9;
  });
}
