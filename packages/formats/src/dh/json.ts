import { norm, normalizeQuaternion, pose, type Pose } from "@twincell/core";
import { Refusal } from "../refusal.ts";
import { shorten } from "../xml.ts";
import { conventionOf, DH_COLUMNS, unitsOf, type DhColumn, type WrittenRow, type WrittenTable } from "./written.ts";

const isRecord = (value: unknown): value is Readonly<Record<string, unknown>> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const isFinite = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);
const textIn = (value: unknown): string | undefined => (typeof value === "string" ? value : undefined);

/** A table as JSON. Entries that are not known are refused: a misspelt `theta` is not 0. */
export function rowsFromJson(text: string): WrittenTable {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (problem) {
    if (problem instanceof SyntaxError) throw new Refusal("The file begins like JSON, but it is no JSON.");
    throw problem;
  }
  if (!isRecord(value) || !Array.isArray(value["rows"])) throw new Refusal("The table has no rows.");
  const units = isRecord(value["units"]) ? value["units"] : {};
  for (const key of Object.keys(value))
    if (!["format", "version", "name", "convention", "units", "rows", "base", "flange", "comment"].includes(key))
      throw new Refusal(`“${shorten(key)}” is no entry of a D-H table.`);
  return {
    name: textIn(value["name"]),
    convention: conventionOf(textIn(value["convention"])),
    ...unitsOf(textIn(units["length"]), textIn(units["angle"])),
    rows: value["rows"].map(rowOf),
    base: poseIn(value["base"], "base"),
    flange: poseIn(value["flange"], "flange"),
  };
}

function rowOf(value: unknown, i: number): WrittenRow {
  if (!isRecord(value)) throw new Refusal(`Row ${i + 1} is not an object.`);
  const numbers: Partial<Record<DhColumn, number>> = {};
  for (const [key, number] of Object.entries(value)) {
    if (key === "name" || key === "comment") continue;
    const column = DH_COLUMNS.find(each => each === key);
    if (column === undefined)
      throw new Refusal(`Row ${i + 1} has an entry “${shorten(key)}”; ${DH_COLUMNS.join(", ")} and name are known.`);
    if (!isFinite(number)) throw new Refusal(`The ${column} of row ${i + 1} is not a finite number.`);
    numbers[column] = number;
  }
  return { name: textIn(value["name"]), line: undefined, numbers };
}

function poseIn(value: unknown, of: string): Pose | undefined {
  if (value === undefined) return undefined;
  const numbers = (key: string, count: number): number[] => {
    const list = isRecord(value) ? value[key] : undefined;
    if (!Array.isArray(list) || list.length !== count || !list.every(isFinite))
      throw new Refusal(`The ${of} wants "${key}" as ${count} finite numbers.`);
    return list;
  };
  const [x, y, z] = numbers("position", 3);
  const [i, j, k, w] = numbers("quaternion", 4);
  if (Math.abs(norm([norm([i!, j!, k!]), w!, 0]) - 1) > 1e-3)
    throw new Refusal(`The quaternion of the ${of} does not have length 1.`);
  return pose([x!, y!, z!], normalizeQuaternion([i!, j!, k!, w!]));
}
