import { describe, expect, test } from "vitest";
import { boxMesh, meshVolume, seededRandom, sphereMesh, type TriangleMesh } from "@twincell/core";
import { readPly } from "../index.ts";

const bytesOf = (text: string): Uint8Array => Uint8Array.from(text, character => character.charCodeAt(0));
const head = (format: string, vertices: number, adapters: number): string =>
  [
    "ply",
    `format ${format} 1.0`,
    "comment a scan",
    `element vertex ${vertices}`,
    "property float x",
    "property float y",
    "property float z",
    "property uchar red",
    `element face ${adapters}`,
    "property list uchar int vertex_indices",
    "property float quality",
    "end_header",
    "",
  ].join("\n");

function binary(mesh: TriangleMesh, little: boolean): Uint8Array {
  const vertices = mesh.positions.length / 3;
  const adapters = mesh.indices.length / 3;
  const header = bytesOf(head(`binary_${little ? "little" : "big"}_endian`, vertices, adapters));
  const bytes = new Uint8Array(header.length + 13 * vertices + 17 * adapters);
  const view = new DataView(bytes.buffer);
  bytes.set(header);
  let at = header.length;
  for (let v = 0; v < vertices; v++, at += 13) {
    for (let k = 0; k < 3; k++) view.setFloat32(at + 4 * k, mesh.positions[3 * v + k]!, little);
    view.setUint8(at + 12, 200);
  }
  for (let f = 0; f < adapters; f++, at += 17) {
    view.setUint8(at, 3);
    for (let k = 0; k < 3; k++) view.setInt32(at + 1 + 4 * k, mesh.indices[3 * f + k]!, little);
    view.setFloat32(at + 13, 0.5, little);
  }
  return bytes;
}
function read(answer: ReturnType<typeof readPly>) {
  if (answer.kind !== "read") throw new Error(answer.sentence);
  return answer;
}

/** A box of 0.4 × 0.3 × 0.2 m with six four-cornered faces, colours between. */
const BOX =
  head("ascii", 8, 6) +
  [0, 1, 2, 3, 4, 5, 6, 7].map(i => `${i & 1 ? 0.4 : 0} ${i & 2 ? 0.3 : 0} ${i & 4 ? 0.2 : 0} 90`).join("\n") +
  "\n4 0 2 3 1 1\n4 4 5 7 6 1\n4 0 1 5 4 1\n4 2 6 7 3 1\n4 0 4 6 2 1\n4 1 3 7 5 1\n";

describe("N-65 a scan as PLY", () => {
  test("ASCII: faces with four corners become triangles, the body is closed and has its volume", () => {
    const { mesh, report } = read(readPly(bytesOf(BOX)));
    expect(report).toMatchObject({
      format: "PLY (ASCII)",
      triangles: 12,
      vertices: 8,
      openEdges: 0,
      crowdedEdges: 0,
      warnings: [],
    });
    expect(meshVolume(mesh)).toBeCloseTo(0.4 * 0.3 * 0.2, 12);
  });

  test.each([true, false])("binary, little endian %s: the same triangles as were written", little => {
    const ball = sphereMesh(0.1, 16, 8);
    const { mesh, report } = read(readPly(binary(ball, little)));
    expect(report).toMatchObject({
      format: "PLY (binary)",
      triangles: ball.indices.length / 3,
      vertices: ball.positions.length / 3,
      openEdges: 0,
    });
    expect(meshVolume(mesh)).toBeCloseTo(meshVolume(ball), 8);
  });

  test("lines may end in CR LF, and the list may be called vertex_index", () => {
    expect(
      read(readPly(bytesOf(BOX.replace("vertex_indices", "vertex_index").replaceAll("\n", "\r\n")))).report.triangles,
    ).toBe(12);
  });

  test("a scan in millimetres is noticed", () => {
    expect(read(readPly(binary(boxMesh([4000, 3000, 2000]), true))).report.likelyScale).toBe(0.001);
  });

  test("a cloud without faces is refused and says what to do", () => {
    const answer = readPly(
      bytesOf(
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 0 0\n",
      ),
    );
    expect(answer).toMatchObject({ kind: "not-understood" });
    expect(answer.kind === "not-understood" && answer.sentence).toMatch(
      /^The file is a cloud of 2 points without faces: make a surface of it first/,
    );
  });

  test.each<[string, string, number?]>([
    ["solid x", "The file does not begin with “ply”: it is no PLY."],
    ["ply\nformat ascii 1.0\n", "The header of the PLY does not end within 65536 bytes."],
    ["ply\nformat ebcdic 1.0\nend_header\n", "“ebcdic” is no encoding of a PLY.", 2],
    [
      "ply\nformat ascii 1.0\nelement vertex many\nend_header\n",
      "“many” stands where the number of elements is expected.",
      3,
    ],
    [
      "ply\nformat ascii 1.0\nelement vertex 999999999\nproperty float x\nend_header\n",
      "The header promises 999999999 elements “vertex”, but the file has 74 bytes.",
    ],
    [
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
      "The vertices have no property “z”.",
    ],
    [BOX.replace("4 1 3 7 5 1", "4 1 3 8 5 1"), "Face 6 names vertex 8; the file has 8, counted from 0.", 26],
    [BOX.replace("4 1 3 7 5 1", "2 1 3 1"), "Face 6 has 2 corners; 3 to 2000 are read.", 26],
    [BOX.replace("4 1 3 7 5 1", "4 1 3"), "The file ends inside its data.", 27],
    [BOX.replace("4 1 3 7 5 1", "4 1 x 7 5 1"), "“x” stands where a number is expected.", 26],
  ])("refused: %j", (text, sentence, line) => {
    expect(readPly(bytesOf(text))).toEqual({
      kind: "not-understood",
      sentence,
      ...(line === undefined ? {} : { line }),
    });
  });

  test("damaged files are read or refused in a sentence, never with a fault (2000 seeded cases)", () => {
    const random = seededRandom(65);
    const sources = [bytesOf(BOX), binary(sphereMesh(1, 6, 4), true), binary(sphereMesh(1, 6, 4), false)];
    let refused = 0;
    for (let i = 0; i < 2000; i++) {
      const source = sources[i % 3]!.slice();
      const cut = random() < 0.3 ? source.subarray(0, Math.floor(random() * source.length)) : source;
      for (let n = Math.floor(random() * 6); n > 0 && cut.length > 0; n--)
        cut[Math.floor(random() * cut.length)] = Math.floor(random() * 256);
      const answer = readPly(cut);
      if (answer.kind === "read") expect(answer.mesh.positions.every(Number.isFinite)).toBe(true);
      else {
        refused++;
        expect(answer.sentence).toMatch(/^.{10,400}[.]$/s);
      }
    }
    expect(refused).toBeGreaterThan(500);
  });
});
