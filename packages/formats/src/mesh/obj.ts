import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { shorten } from "../xml.ts";
import { addPolygon, MAX_CORNERS } from "./polygon.ts";
import { finishMesh, type MeshRead } from "./report.ts";
import { latin1 } from "./text.ts";

/**
 * Reads the surface of a Wavefront OBJ: vertices and faces. Faces with more than three corners are cut into triangles.
 */
export function readObj(bytes: Uint8Array): MeshRead | NotUnderstood {
  return answering(() => {
    const text = latin1(bytes).replace(/\\\r?\n/g, " ");
    const positions: number[] = [];
    const indices: number[] = [];
    const warnings: string[] = [];
    let line = 0;
    let lines = 0;
    for (let at = 0; at < text.length; ) {
      const end = text.indexOf("\n", at);
      const words = text
        .slice(at, end < 0 ? text.length : end)
        .trim()
        .split(/\s+/);
      at = end < 0 ? text.length : end + 1;
      line++;
      if (words[0] === "v") for (let k = 1; k <= 3; k++) positions.push(coordinate(words[k], line));
      else if (words[0] === "f") addFace(words.slice(1), positions, indices, line);
      else if (words[0] === "l" || words[0] === "p") lines++;
      else if (words[0] === "curv" || words[0] === "surf")
        throw new Refusal("The file describes free-form surfaces; only polygons are read.", line);
    }
    if (indices.length === 0) throw new Refusal("The file holds no faces.");
    if (lines > 0) warnings.push(`${lines} lines and points without surface were passed over.`);
    return finishMesh("OBJ", { positions: Float64Array.from(positions), indices: Uint32Array.from(indices) }, warnings);
  });
}

function coordinate(word: string | undefined, line: number): number {
  const value = word === undefined || word === "" ? NaN : Number(word);
  if (Number.isNaN(value) && !/^[+-]?(nan|inf)/i.test(word ?? ""))
    throw new Refusal(`“${shorten(word ?? "")}” stands where a coordinate is expected.`, line);
  return value;
}

function addFace(words: readonly string[], positions: readonly number[], indices: number[], line: number): void {
  const count = positions.length / 3;
  if (words.length < 3) throw new Refusal(`A face has ${words.length} corners.`, line);
  if (words.length > MAX_CORNERS)
    throw new Refusal(`A face has ${words.length} corners; at most ${MAX_CORNERS} are read.`, line);
  const corners = words.map(word => {
    const written = word.split("/", 1)[0]!;
    const number = Number(written);
    const index = number < 0 ? count + number : number - 1;
    if (!/^-?\d+$/.test(written) || index < 0 || index >= count)
      throw new Refusal(`A face names vertex ${shorten(word)}; ${count} vertices come before it.`, line);
    return index;
  });
  addPolygon(corners, positions, indices);
}
