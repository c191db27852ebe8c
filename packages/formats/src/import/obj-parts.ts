import { Refusal } from "../refusal.ts";
import { addPolygon, MAX_CORNERS } from "../mesh/polygon.ts";
import { latin1 } from "../mesh/text.ts";
import { utf8 } from "../utf8.ts";
import { shorten } from "../xml.ts";
import type { RawPart, RawParts, Rgb } from "./part.ts";

interface OpenPart {
  readonly name: string;
  readonly material: string;
  readonly indices: number[];
}

/**
 * A Wavefront OBJ part by part: one for each object or group and material, coloured as its MTL says (Kd).
 *
 * @param other  bytes of a file that this one names.
 * @throws {Refusal} for what is no OBJ.
 */
export function objParts(bytes: Uint8Array, other: (address: string) => Uint8Array | undefined): RawParts {
  const text = latin1(bytes).replace(/\\\r?\n/g, " ");
  const positions: number[] = [];
  const notes: string[] = [];
  const parts = new Map<string, OpenPart>();
  const materials = new Map<string, Rgb>();
  let name = "";
  let material = "";
  let current: OpenPart | undefined;
  let line = 0;
  let passed = 0;
  for (let at = 0; at < text.length; ) {
    const end = text.indexOf("\n", at);
    const words = text
      .slice(at, end < 0 ? text.length : end)
      .trim()
      .split(/\s+/);
    at = end < 0 ? text.length : end + 1;
    line++;
    const [keyword] = words;
    if (keyword === "v") for (let k = 1; k <= 3; k++) positions.push(coordinate(words[k], line));
    else if (keyword === "f") {
      const key = `${name}\n${material}`;
      current ??= parts.get(key) ?? { name, material, indices: [] };
      parts.set(key, current);
      addFace(words, positions, current.indices, line);
    } else if (keyword === "o" || keyword === "g" || keyword === "usemtl") {
      const said = words.slice(1).join(" ");
      if (keyword === "usemtl") material = said;
      else name = said;
      current = undefined;
    } else if (keyword === "mtllib") readMaterials(words.slice(1).join(" "), other, materials, notes);
    else if (keyword === "l" || keyword === "p") passed++;
    else if (keyword === "curv" || keyword === "surf")
      throw new Refusal("The file describes free-form surfaces; only polygons are read.", line);
  }
  if (passed > 0) notes.push(`${passed} lines and points without surface were passed over.`);
  const found = [...parts.values()].filter(part => part.indices.length > 0);
  if (found.length === 0) throw new Refusal("The file holds no faces.");
  return { format: "OBJ", notes, parts: found.map(part => partOf(part, positions, materials)) };
}

/** Only the corners that the part uses are kept. */
function partOf(
  { name, material, indices }: OpenPart,
  all: readonly number[],
  materials: ReadonlyMap<string, Rgb>,
): RawPart {
  const newOf = new Map<number, number>();
  const positions: number[] = [];
  const kept = Uint32Array.from(indices, old => {
    const known = newOf.get(old);
    if (known !== undefined) return known;
    const made = newOf.size;
    newOf.set(old, made);
    positions.push(all[3 * old]!, all[3 * old + 1]!, all[3 * old + 2]!);
    return made;
  });
  return {
    name: name === "" || name === "default" ? material : name,
    path: [],
    color: materials.get(material),
    mesh: { positions: Float64Array.from(positions), indices: kept },
  };
}

function readMaterials(
  address: string,
  other: (address: string) => Uint8Array | undefined,
  materials: Map<string, Rgb>,
  notes: string[],
): void {
  const bytes = other(address);
  if (!bytes) {
    notes.push(`${shorten(address)} with the colours was not given: drop it together with the OBJ to keep them.`);
    return;
  }
  let name: string | undefined;
  for (const line of utf8(bytes).split("\n")) {
    const [keyword = "", ...words] = line.trim().split(/\s+/);
    if (keyword === "newmtl") name = words.join(" ");
    if (keyword !== "Kd" || name === undefined) continue;
    const [red, green, blue] = words.map(Number);
    if ([red, green, blue].every(Number.isFinite)) materials.set(name, [red!, green!, blue!]);
    else notes.push(`The colour of material ${shorten(name)} is no colour: “${shorten(words.join(" "))}”.`);
  }
}

function coordinate(word: string | undefined, line: number): number {
  const value = word === undefined || word === "" ? NaN : Number(word);
  if (Number.isNaN(value) && !/^[+-]?(nan|inf)/i.test(word ?? ""))
    throw new Refusal(`“${shorten(word ?? "")}” stands where a coordinate is expected.`, line);
  return value;
}

function addFace(words: readonly string[], positions: readonly number[], indices: number[], line: number): void {
  const count = positions.length / 3;
  if (words.length < 4) throw new Refusal(`A face has ${words.length - 1} corners.`, line);
  if (words.length - 1 > MAX_CORNERS)
    throw new Refusal(`A face has ${words.length - 1} corners; at most ${MAX_CORNERS} are read.`, line);
  const corners = words.slice(1).map(word => {
    const written = word.split("/", 1)[0]!;
    const number = Number(written);
    const index = number < 0 ? count + number : number - 1;
    if (!/^-?\d+$/.test(written) || index < 0 || index >= count)
      throw new Refusal(`A face names vertex ${shorten(word)}; ${count} vertices come before it.`, line);
    return index;
  });
  addPolygon(corners, positions, indices);
}
