import { PlainFault, type TriangleMesh } from "@twincell/core";
import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { shorten } from "../xml.ts";
import { finishMesh, type MeshRead } from "./report.ts";
import { latin1 } from "./text.ts";

const HEADER = 80;
const FACET = 50;
const LARGEST_FILE = 512_000_000;

/**
 * Reads an STL, ASCII or binary: a file whose length fits its triangle count is binary whatever its header says.
 * Row M-03. Normals in the file are not used: the winding counts.
 */
export function readStl(bytes: Uint8Array): MeshRead | NotUnderstood {
  return answering(() => {
    if (bytes.length > LARGEST_FILE)
      throw new Refusal(`The file has ${bytes.length} bytes; at most ${LARGEST_FILE} are read.`);
    const warnings: string[] = [];
    if (bytes.length === 0) throw new Refusal("The file is empty.");
    const counted = bytes.length >= HEADER + 4 ? viewOf(bytes).getUint32(HEADER, true) : -1;
    if (counted >= 0 && bytes.length === HEADER + 4 + FACET * counted)
      return finishMesh("STL (binary)", readBinary(bytes, counted), warnings);
    if (/^\s*solid\b/i.test(latin1(bytes.subarray(0, 512))))
      return finishMesh("STL (ASCII)", readAscii(latin1(bytes)), warnings);
    if (counted < 0)
      throw new Refusal(`The file has ${bytes.length} bytes and does not begin with “solid”: it is no STL.`);
    const room = Math.floor((bytes.length - HEADER - 4) / FACET);
    if (counted > room)
      throw new Refusal(`The header promises ${counted} triangles, but the file has room for ${room}.`);
    warnings.push(`${bytes.length - HEADER - 4 - FACET * counted} bytes after the last triangle were passed over.`);
    return finishMesh("STL (binary)", readBinary(bytes, counted), warnings);
  });
}

const viewOf = (bytes: Uint8Array): DataView => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

function readBinary(bytes: Uint8Array, triangles: number): TriangleMesh {
  const view = viewOf(bytes);
  const positions = new Float64Array(9 * triangles);
  for (let t = 0; t < triangles; t++) {
    const at = HEADER + 4 + FACET * t + 12;
    for (let k = 0; k < 9; k++) positions[9 * t + k] = view.getFloat32(at + 4 * k, true);
  }
  return { positions, indices: Uint32Array.from({ length: 3 * triangles }, (_, i) => i) };
}

/** Words are taken one by one; only `vertex` lines and the bounds of facets matter. */
function readAscii(text: string): TriangleMesh {
  const positions: number[] = [];
  const words = /[^\s]+/g;
  let corners = 0;
  let facets = 0;
  for (let match = words.exec(text); match; match = words.exec(text)) {
    const word = match[0].toLowerCase();
    if (word === "solid" || word === "endsolid") {
      // The rest of the line is a name, and names may hold any word.
      const end = text.indexOf("\n", match.index);
      words.lastIndex = end < 0 ? text.length : end;
    } else if (word === "facet") {
      corners = 0;
      facets++;
    } else if (word === "vertex") {
      if (++corners > 3 || facets === 0)
        throw new Refusal("A facet has more than three corners.", lineAt(text, match.index));
      for (let k = 0; k < 3; k++) positions.push(numberIn(words.exec(text)?.[0], text, match.index));
    } else if (word === "endfacet" && corners !== 3)
      throw new Refusal(`A facet has ${corners} corners instead of three.`, lineAt(text, match.index));
  }
  if (corners !== 3 && facets > 0) throw new Refusal("The file ends inside a facet.", lineAt(text, text.length));
  return {
    positions: Float64Array.from(positions),
    indices: Uint32Array.from({ length: positions.length / 3 }, (_, i) => i),
  };
}

/** NaN and infinity are numbers here: their triangles are counted and left out later. */
function numberIn(word: string | undefined, text: string, at: number): number {
  if (word === undefined) throw new Refusal("The file ends inside a corner.", lineAt(text, at));
  const value = Number(word);
  if (Number.isNaN(value) && !/^[+-]?(nan|inf|-?1\.#)/i.test(word))
    throw new Refusal(`“${shorten(word)}” stands where a coordinate is expected.`, lineAt(text, at));
  return value;
}

function lineAt(text: string, index: number): number {
  let line = 1;
  for (let at = text.indexOf("\n"); at >= 0 && at < index; at = text.indexOf("\n", at + 1)) line++;
  return line;
}

/** The mesh as a binary STL; coordinates are rounded to 32 bits, as the format has it. */
export function writeStl(mesh: TriangleMesh, name = "twincell"): Uint8Array {
  const { positions: p, indices } = mesh;
  const triangles = indices.length / 3;
  const bytes = new Uint8Array(HEADER + 4 + FACET * triangles);
  const view = viewOf(bytes);
  if (name.toLowerCase().startsWith("solid"))
    throw new PlainFault(
      "formats.stl-name",
      `A binary STL cannot be named “${shorten(name)}”.`,
      "Names that begin with “solid” mark ASCII files: choose another.",
    );
  for (let i = 0; i < Math.min(HEADER, name.length); i++) bytes[i] = name.charCodeAt(i) & 0x7f;
  view.setUint32(HEADER, triangles, true);
  for (let t = 0; t < triangles; t++) {
    const at = HEADER + 4 + FACET * t;
    const [a, b, c] = [3 * indices[3 * t]!, 3 * indices[3 * t + 1]!, 3 * indices[3 * t + 2]!];
    const u = [0, 1, 2].map(k => p[b + k]! - p[a + k]!);
    const v = [0, 1, 2].map(k => p[c + k]! - p[a + k]!);
    const normal = [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!];
    const length = Math.hypot(...normal) || 1;
    for (let k = 0; k < 3; k++) {
      view.setFloat32(at + 4 * k, normal[k]! / length, true);
      view.setFloat32(at + 12 + 4 * k, p[a + k]!, true);
      view.setFloat32(at + 24 + 4 * k, p[b + k]!, true);
      view.setFloat32(at + 36 + 4 * k, p[c + k]!, true);
    }
  }
  return bytes;
}
