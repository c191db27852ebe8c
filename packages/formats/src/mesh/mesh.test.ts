import { describe, expect, test } from "vitest";
import { boxMesh, meshVolume, seededRandom, sphereMesh, torusMesh, type TriangleMesh } from "@twincell/core";
import { readObj, readStl, writeStl } from "../index.ts";

const bytesOf = (text: string): Uint8Array => Uint8Array.from(text, character => character.charCodeAt(0));
const asciiStl = (mesh: TriangleMesh, name = "part"): string => {
  const lines = [`solid ${name}`];
  for (let t = 0; t < mesh.indices.length; t += 3) {
    lines.push(" facet normal 0 0 1", "  outer loop");
    for (let c = 0; c < 3; c++)
      lines.push(
        `   vertex ${Array.from(mesh.positions.slice(3 * mesh.indices[t + c]!, 3 * mesh.indices[t + c]! + 3)).join(" ")}`,
      );
    lines.push("  endloop", " endfacet");
  }
  return [...lines, `endsolid ${name}`, ""].join("\n");
};
function read(answer: ReturnType<typeof readStl>) {
  if (answer.kind !== "read") throw new Error(answer.sentence);
  return answer;
}

describe("M-03 STL", () => {
  const ball = sphereMesh(0.1, 16, 8);

  test("written binary, read back: same triangles, welded, closed", () => {
    const { mesh, report } = read(readStl(writeStl(ball)));
    expect(report).toMatchObject({
      format: "STL (binary)",
      triangles: ball.indices.length / 3,
      vertices: ball.positions.length / 3,
      withoutArea: 0,
      notFinite: 0,
      openEdges: 0,
      crowdedEdges: 0,
      likelyScale: 1,
      warnings: [],
    });
    expect(meshVolume(mesh)).toBeCloseTo(meshVolume(ball), 9);
  });

  test("M-04 the number of facets is that of the source, ASCII and binary", () => {
    for (const facets of [4, 37, 500]) {
      const ring = torusMesh(1, 0.3, facets, 3);
      const count = ring.indices.length / 3;
      const binary = writeStl(ring);
      expect(new DataView(binary.buffer).getUint32(80, true)).toBe(count);
      expect(read(readStl(binary)).report.triangles).toBe(count);
      expect(read(readStl(bytesOf(asciiStl(ring)))).report.triangles).toBe(asciiStl(ring).split("endfacet").length - 1);
    }
  });

  test("the bytes are those of the format", () => {
    const bytes = writeStl(
      { positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), indices: Uint32Array.of(0, 1, 2) },
      "x",
    );
    expect(bytes.length).toBe(134);
    expect(Array.from(bytes.slice(80, 96))).toEqual([1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x80, 0x3f]);
    expect(Array.from(bytes.slice(108, 112))).toEqual([0, 0, 0x80, 0x3f]);
    expect(() => writeStl(ball, "Solid gold")).toThrow("cannot be named");
  });

  test("ASCII, with names that hold keywords, capitals and several solids", () => {
    const text = `${asciiStl(ball, "a vertex facet")}${asciiStl(boxMesh([1, 1, 1])).toUpperCase()}`;
    const { mesh, report } = read(readStl(bytesOf(text)));
    expect(report).toMatchObject({ format: "STL (ASCII)", triangles: ball.indices.length / 3 + 12, openEdges: 0 });
    expect(meshVolume(mesh)).toBeCloseTo(meshVolume(ball) + 1, 9);
  });

  test("a binary file whose header begins with “solid” is told by its length", () => {
    const bytes = writeStl(ball);
    bytes.set(bytesOf("solid by a careless exporter"), 0);
    expect(read(readStl(bytes)).report.format).toBe("STL (binary)");
  });

  test("N-02 numbers in millimetres are noticed", () => {
    const { report } = read(readStl(bytesOf(asciiStl(boxMesh([400, 300, 1185])))));
    expect(report.likelyScale).toBe(0.001);
    expect(report.warnings).toEqual([
      "The part would be 1.19e+3 m long; its numbers are probably millimetres (scale 0.001).",
    ]);
    expect(report.size[2] * report.likelyScale).toBeCloseTo(1.185, 9);
  });

  test("N-03 an open shell is warned of", () => {
    const box = boxMesh([1, 1, 1]);
    expect(read(readStl(writeStl({ positions: box.positions, indices: box.indices.slice(3) }))).report).toMatchObject({
      openEdges: 3,
      warnings: ["The surface is open along 3 edges: inside and outside are not certain."],
    });
  });

  test("triangles without area and with NaN are left out and counted", () => {
    const positions = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, NaN, 0, 0, 2, 0, 0);
    const { mesh, report } = read(
      readStl(writeStl({ positions, indices: Uint32Array.of(0, 1, 2, 0, 1, 1, 0, 1, 5, 0, 1, 4) })),
    );
    expect(mesh.indices.length).toBe(3);
    expect(report).toMatchObject({ triangles: 4, withoutArea: 2, notFinite: 1 });
  });

  test.each<[string, Uint8Array, string, number?]>([
    ["empty", new Uint8Array(), "The file is empty."],
    ["not an STL", bytesOf("hello"), "The file has 5 bytes and does not begin with “solid”: it is no STL."],
    ["cut short", writeStl(ball).slice(0, 300), "The header promises 224 triangles, but the file has room for 4."],
    [
      "two corners",
      bytesOf("solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n"),
      "A facet has 2 corners instead of three.",
      5,
    ],
    [
      "four corners",
      bytesOf("solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n"),
      "A facet has more than three corners.",
      6,
    ],
    [
      "a word for a number",
      bytesOf("solid x\nfacet\nvertex 0 zero 0\n"),
      "“zero” stands where a coordinate is expected.",
      3,
    ],
    ["cut in a corner", bytesOf("solid x\nfacet\nvertex 0 0"), "The file ends inside a corner.", 3],
    ["cut in a facet", bytesOf("solid x\nfacet\nvertex 0 0 0\n"), "The file ends inside a facet.", 4],
  ])("refused: %s", (_, bytes, sentence, line) => {
    expect(readStl(bytes)).toEqual({ kind: "not-understood", sentence, ...(line === undefined ? {} : { line }) });
  });
});

describe("OBJ", () => {
  test("polygons, counted from both ends, with textures, normals, colours and a line carried on", () => {
    const text =
      "# a cube\nmtllib x.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nvn 0 0 1\nvt 0 0\n" +
      "g box\nf 4 3 2 1\nf 5/1/1 6/1/1 7/1/1 8/1/1\nf 1//1 2//1 6//1 5//1\nf -7 -6 -2 \\\n-3\nf 3 4 8 7\nf 4 1 5 8\nl 1 2\n";
    const answer = readObj(bytesOf(text));
    if (answer.kind !== "read") throw new Error(answer.sentence);
    expect(answer.report).toMatchObject({ format: "OBJ", triangles: 12, vertices: 8, openEdges: 0, crowdedEdges: 0 });
    expect(meshVolume(answer.mesh)).toBeCloseTo(1, 12);
  });

  test("concave faces in any plane keep their hollow and their winding", () => {
    const outline = [
      [0, 0],
      [2, 0],
      [2, 1],
      [1, 1],
      [1, 2],
      [0, 2],
    ];
    for (const place of [
      ([x, y]: number[]) => [x, y, 0],
      ([x, y]: number[]) => [0, x, y],
      ([x, y]: number[]) => [y, 0, x],
      ([x, y]: number[]) => [y, x, 0],
    ]) {
      const points = outline.map(place);
      const adapters = "f 1 2 3 4 5 6";
      const answer = readObj(bytesOf(`${points.map(p => `v ${p.join(" ")}`).join("\n")}\n${adapters}`));
      if (answer.kind !== "read") throw new Error(answer.sentence);
      let area = [0, 0, 0];
      const { positions: p, indices } = answer.mesh;
      for (let t = 0; t < indices.length; t += 3) {
        const [a, b, c] = [0, 1, 2].map(i => Array.from(p.slice(3 * indices[t + i]!, 3 * indices[t + i]! + 3)));
        const u = b!.map((v, k) => v - a![k]!);
        const w = c!.map((v, k) => v - a![k]!);
        area = area.map((v, k) => v + (u[(k + 1) % 3]! * w[(k + 2) % 3]! - u[(k + 2) % 3]! * w[(k + 1) % 3]!) / 2);
      }
      let newell = [0, 0, 0];
      points.forEach((a, i) => {
        const b = points[(i + 1) % points.length]!;
        newell = newell.map((v, k) => v + (a[(k + 1) % 3]! * b[(k + 2) % 3]! - a[(k + 2) % 3]! * b[(k + 1) % 3]!) / 2);
      });
      area.forEach((v, k) => {
        expect(v).toBeCloseTo(newell[k]!, 12);
      });
      expect(Math.hypot(...area)).toBeCloseTo(3, 12);
    }
  });

  test.each([
    ["v 0 0 0\nf 1 2 3\n", "A face names vertex 2; 1 vertices come before it.", 2],
    ["v 0 0 0\nv 1 0 0\nf 1 2\n", "A face has 2 corners.", 3],
    ["v 0 x 0\n", "“x” stands where a coordinate is expected.", 1],
    ["v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "A face names vertex 0; 3 vertices come before it.", 4],
  ])("refused: %j", (text, sentence, line) => {
    expect(readObj(bytesOf(text))).toEqual({ kind: "not-understood", sentence, line });
  });
  test("refused: no faces", () => {
    expect(readObj(bytesOf("v 0 0 0\n"))).toEqual({ kind: "not-understood", sentence: "The file holds no faces." });
  });
});

test("damaged files are read or refused in a sentence, never with a fault (3000 seeded cases)", () => {
  const random = seededRandom(31);
  const ring = torusMesh(1, 0.3, 6, 5);
  const sources = [
    writeStl(ring),
    bytesOf(asciiStl(ring)),
    bytesOf(Array.from({ length: 8 }, (_, i) => `v ${i} ${i % 3} ${i % 2}\n`).join("") + "f 1 2 3 4 5\nf 6/1 -1/2 2\n"),
  ];
  let refused = 0;
  for (let i = 0; i < 3000; i++) {
    const source = sources[i % 3]!.slice();
    const cut = random() < 0.5 ? source.subarray(0, Math.floor(random() * source.length)) : source;
    for (let n = Math.floor(random() * 8); n > 0 && cut.length > 0; n--)
      cut[Math.floor(random() * cut.length)] = Math.floor(random() * 256);
    for (const answer of [readStl(cut), readObj(cut)]) {
      if (answer.kind === "read") expect(answer.mesh.positions.every(Number.isFinite)).toBe(true);
      else {
        refused++;
        expect(answer.sentence).toMatch(/^.{10,250}[.]$/s);
      }
    }
  }
  expect(refused).toBeGreaterThan(1000);
});
