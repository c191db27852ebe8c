import { PALLET_ORDERS, PALLET_PATTERNS, type Pallet } from "../pallet.ts";
import type { Vector3 } from "../../spatial/vector.ts";
import { keys, type Fields, type Reader } from "../../json/reader.ts";

/** A pattern with more places than this is a mistake. */
const MOST_PLACES = 100_000;

export function readPallets(
  reader: Reader,
  value: unknown,
  frames: Readonly<Record<string, unknown>>,
): Readonly<Record<string, Pallet>> {
  if (value === undefined) return {};
  const table = reader.object(value, "pallets", "the table of pallets");
  const entries: [string, Pallet][] = [];
  for (const [name, entry] of Object.entries(table ?? {})) {
    const path = `pallets.${name}`;
    const what = `the pallet “${name}”`;
    const fields = reader.object(entry, path, what);
    if (name === "") reader.fault(path, "A pallet has a name that is not empty.");
    if (name === "world" || Object.hasOwn(frames, name))
      reader.fault(path, `${what} has the name of a frame; inside a pallet step the name means its places.`);
    const pallet = fields === undefined ? undefined : readPallet(reader, fields, path, what, frames);
    if (pallet !== undefined) entries.push([name, pallet]);
  }
  return Object.fromEntries(entries);
}

function readPallet(
  reader: Reader,
  fields: Fields,
  path: string,
  what: string,
  frames: Readonly<Record<string, unknown>>,
): Pallet | undefined {
  reader.onlyKeys(
    fields,
    path,
    what,
    keys<Pallet>()(
      "frame",
      "origin",
      "rowEnd",
      "columnEnd",
      "rows",
      "columns",
      "layers",
      "layer_m",
      "interleave",
      "order",
    ),
  );
  const frame = readFrame(reader, fields.frame, `${path}.frame`, what, frames);
  const origin = reader.pose<"frame", "place">(fields.origin, `${path}.origin`, `the first place of ${what}`);
  const rowEnd = reader.numbers(fields.rowEnd, `${path}.rowEnd`, `the end of the first row of ${what}`, "m", 3);
  const columnEnd = reader.numbers(
    fields.columnEnd,
    `${path}.columnEnd`,
    `the end of the first column of ${what}`,
    "m",
    3,
  );
  const size = readSize(reader, fields, path, what);
  const interleave = oneOf(reader, fields.interleave, PALLET_PATTERNS, `${path}.interleave`, `the pattern of ${what}`);
  const order = oneOf(reader, fields.order, PALLET_ORDERS, `${path}.order`, `the order of ${what}`);
  if (interleave === "odd-rows-shifted" && size !== undefined && size.columns < 2)
    reader.fault(
      `${path}.columns`,
      `${what} has shifted rows, which have one place fewer; it needs 2 columns or more.`,
    );
  if (origin === undefined || rowEnd === undefined || columnEnd === undefined || size === undefined) return undefined;
  return {
    frame,
    origin,
    rowEnd: rowEnd as Vector3,
    columnEnd: columnEnd as Vector3,
    ...size,
    ...(interleave === undefined ? {} : { interleave }),
    ...(order === undefined ? {} : { order }),
  };
}

/** The frame a pallet stands in; the world where none is named. */
function readFrame(
  reader: Reader,
  value: unknown,
  path: string,
  what: string,
  frames: Readonly<Record<string, unknown>>,
): string {
  if (value === undefined) return "world";
  const frame = reader.name(value, path, `the frame of ${what}`) ?? "world";
  if (frame !== "world" && !Object.hasOwn(frames, frame))
    reader.fault(
      path,
      `${what} stands in the frame “${frame}”, which the program does not have; it has ${["world", ...Object.keys(frames)].join(", ")}.`,
    );
  return frame;
}

/** Rows, columns and layers with their height: one layer where none is told. */
function readSize(
  reader: Reader,
  fields: Fields,
  path: string,
  what: string,
): Pick<Pallet, "rows" | "columns" | "layers" | "layer_m"> | undefined {
  const rows = count(reader, fields.rows, `${path}.rows`, `the number of rows of ${what}`);
  const columns = count(reader, fields.columns, `${path}.columns`, `the number of columns of ${what}`);
  const layers =
    fields.layers === undefined ? 1 : count(reader, fields.layers, `${path}.layers`, `the number of layers of ${what}`);
  const layer_m =
    fields.layer_m === undefined
      ? 0
      : reader.number(fields.layer_m, `${path}.layer_m`, `the height of a layer of ${what}`, "m");
  if (rows === undefined || columns === undefined || layers === undefined) return undefined;
  if (rows * columns * layers > MOST_PLACES)
    reader.fault(path, `${what} has ${rows * columns * layers} places; ${MOST_PLACES} are the most.`);
  return layer_m === undefined ? undefined : { rows, columns, layers, layer_m };
}

function count(reader: Reader, value: unknown, path: string, what: string): number | undefined {
  return typeof value === "number" && Number.isInteger(value) && value >= 1
    ? value
    : reader.fault(path, `${what} is a whole number from 1; here it is ${reader.shown(value)}.`);
}

function oneOf<T extends string>(
  reader: Reader,
  value: unknown,
  words: readonly T[],
  path: string,
  what: string,
): T | undefined {
  if (value === undefined) return undefined;
  return (
    words.find(word => word === value) ??
    reader.fault(path, `${what} is one of ${words.join(", ")}; here it is ${reader.shown(value)}.`)
  );
}
