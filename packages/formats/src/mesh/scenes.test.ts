import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { meshBounds, meshVolume, seededRandom } from "@twincell/core";
import { readDae, readGltf, readMesh, type MeshRead, type NotUnderstood } from "../index.ts";

const folder = new URL("../../../../fixtures/meshes/", import.meta.url);
const bytesIn = (name: string): Uint8Array => readFileSync(new URL(name, folder));
const bytesOf = (text: string): Uint8Array => new TextEncoder().encode(text);
function read(answer: MeshRead | NotUnderstood): MeshRead {
  if (answer.kind !== "read") throw new Error(answer.sentence);
  return answer;
}

interface Witness {
  readonly triangles: number;
  readonly vertices: number;
  readonly volume_m3: number;
  readonly lower: number[];
  readonly upper: number[];
}
const witness = (
  JSON.parse(readFileSync(new URL("witness.json", folder), "utf8")) as { files: Record<string, Witness> }
).files;

test.each(Object.keys(witness))(
  "X-01, X-02, M-04 %s: triangles, welded corners, volume and size are those another program reads",
  name => {
    const { mesh, report } = read(readMesh(name, bytesIn(name)));
    const wanted = witness[name]!;
    const { lower, upper } = meshBounds(mesh);
    expect([report.triangles, report.vertices, report.openEdges, report.crowdedEdges]).toEqual([
      wanted.triangles,
      wanted.vertices,
      0,
      0,
    ]);
    expect(meshVolume(mesh) / wanted.volume_m3).toBeCloseTo(1, 6);
    for (let k = 0; k < 3; k++) {
      expect(Math.abs(lower[k]! - wanted.lower[k]!)).toBeLessThan(1e-7);
      expect(Math.abs(upper[k]! - wanted.upper[k]!)).toBeLessThan(1e-7);
    }
  },
);

describe("COLLADA", () => {
  const text = new TextDecoder().decode(bytesIn("parts.dae"));
  test("what was passed over is counted", () => {
    expect(read(readDae(bytesIn("parts.dae"))).report).toMatchObject({
      format: "COLLADA",
      warnings: ["1 line set, 1 camera passed over: only surfaces are read."],
    });
  });
  test("the unit scales, the up axis turns", () => {
    const bounds = (from: string) => meshBounds(read(readDae(bytesOf(from))).mesh);
    const upright = bounds(text);
    const lying = bounds(text.replace("Y_UP", "Z_UP"));
    const larger = bounds(text.replace('meter="0.01"', 'meter="1"'));
    expect(lying.upper[1]).toBeCloseTo(upright.upper[2], 12);
    expect(larger.upper[0]).toBeCloseTo(100 * upright.upper[0], 9);
  });
  test.each<[string, string, string]>([
    ["<COLLADA", "<html", "The file is not XML: unexpected close tag."],
    ['meter="0.01"', 'meter="-1"', "The unit of the file is -1 m."],
    ["Y_UP", "W_UP", "The file is “W_UP”; X_UP, Y_UP and Z_UP are known."],
    ["<p>0 2 1", "<p>0 9 1", "A face names vertex 9; there are 4."],
    ["<p>0 2 1", "<p>0 x 1", "“x” stands where a number is expected."],
    ["<p>0 2 1", "<p>0 1.5 1", "1.5 stands where a vertex is named."],
    ["<vcount>4 4", "<vcount>4 9", "The polygons want 29 corners, but 24 are given."],
    ['url="#pair"', 'url="#nobody"', "“#nobody” is not in the file."],
    ["<translate>5 0 0<", "<translate>5 0<", "A <translate> has 2 numbers instead of 3 finite ones."],
    [
      '<node id="pair">',
      '<node id="pair"><instance_node url="#pair"/>',
      "The nodes of the file hold each other more than 64 deep.",
    ],
  ])("refused: %s", (from, to, sentence) => {
    expect(text).toContain(from);
    expect(readDae(bytesOf(text.replace(from, to)))).toMatchObject({
      kind: "not-understood",
      sentence: expect.stringContaining(sentence.replace(/[.]$/, "")) as string,
    });
  });
});

describe("glTF", () => {
  const corners = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
  const triangles = new Uint16Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
  const base64 = (...parts: ArrayBufferView[]): string =>
    Buffer.concat(parts.map(part => Buffer.from(part.buffer, part.byteOffset, part.byteLength))).toString("base64");
  const whole = {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0, translation: [1, 2, 3], scale: [2, 2, -2] }] as Record<string, unknown>[],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 } as Record<string, unknown>] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: "VEC3" },
      { bufferView: 1, componentType: 5123, count: 12, type: "SCALAR" },
    ] as Record<string, unknown>[],
    bufferViews: [
      { buffer: 0, byteLength: 48 },
      { buffer: 0, byteOffset: 48, byteLength: 24 },
    ] as Record<string, unknown>[],
    buffers: [{ byteLength: 72, uri: `data:application/octet-stream;base64,${base64(corners, triangles)}` }] as Record<
      string,
      unknown
    >[],
  };
  const file = (change: (json: typeof whole) => void): Uint8Array => {
    const json = structuredClone(whole);
    change(json);
    return bytesOf(JSON.stringify(json));
  };

  test("JSON with a buffer inside: y up becomes z up, a mirrored part stays outward", () => {
    const { mesh, report } = read(readGltf(file(() => undefined)));
    expect(report).toMatchObject({ format: "glTF", triangles: 4, vertices: 4, openEdges: 0 });
    expect(meshVolume(mesh)).toBeCloseTo(8 / 6, 9);
    expect(meshBounds(mesh)).toEqual({ lower: [1, -3, 2], upper: [3, -1, 4] });
  });
  test("a buffer in a file beside it, strips, sparse corners and normalised integers", () => {
    const beside = file(json => {
      json.buffers[0]!["uri"] = "parts.bin";
    });
    const bin = new Uint8Array(Buffer.from(base64(corners, triangles), "base64"));
    expect(meshVolume(read(readGltf(beside, address => (address === "parts.bin" ? bin : undefined))).mesh)).toBeCloseTo(
      8 / 6,
      9,
    );
    expect(readGltf(beside)).toMatchObject({ sentence: "parts.bin is missing." });
    expect(
      read(
        readGltf(
          file(json => {
            json.meshes[0]!.primitives[0] = { attributes: { POSITION: 0 }, mode: 5 };
          }),
        ),
      ).report.triangles,
    ).toBe(2);
    const sparse = file(json => {
      json.buffers.push({
        byteLength: 14,
        uri: `data:;base64,${base64(new Uint16Array([3]), new Float32Array([0, 0, 5]))}`,
      });
      json.bufferViews.push({ buffer: 1, byteLength: 2 }, { buffer: 1, byteOffset: 2, byteLength: 12 });
      json.accessors[0]!["sparse"] = {
        count: 1,
        indices: { bufferView: 2, componentType: 5123 },
        values: { bufferView: 3 },
      };
    });
    expect(meshVolume(read(readGltf(sparse)).mesh)).toBeCloseTo((5 * 8) / 6, 9);
    const small = file(json => {
      json.buffers.push({
        byteLength: 12,
        uri: `data:;base64,${base64(new Int8Array([0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, -128]))}`,
      });
      json.bufferViews.push({ buffer: 1, byteLength: 12 });
      json.accessors[0] = { bufferView: 2, componentType: 5120, normalized: true, count: 4, type: "VEC3" };
    });
    expect(meshBounds(read(readGltf(small)).mesh).upper[1]).toBeCloseTo(-3, 12);
  });
  test.each<[string, Uint8Array, string]>([
    ["empty", new Uint8Array(), "The file is neither a GLB nor the JSON of a glTF."],
    ["text", bytesOf("hello"), "The file is neither a GLB nor the JSON of a glTF."],
    [
      "version 1",
      file(json => {
        json.asset.version = "1.0";
      }),
      "The file is glTF 1.0; glTF 2 is read.",
    ],
    [
      "compressed",
      file(json => {
        Object.assign(json, { extensionsRequired: ["KHR_draco_mesh_compression"] });
      }),
      "The file needs KHR_draco_mesh_compression, which is not read.",
    ],
    [
      "beyond the buffer",
      file(json => {
        json.accessors[0]!["count"] = 9;
      }),
      "accessors[0] of the glTF reaches beyond its buffer.",
    ],
    [
      "a huge count",
      file(json => {
        json.accessors[0]!["count"] = 4e9;
      }),
      "accessors[0] of the glTF has 4000000000 elements; at most 20000000 are read.",
    ],
    [
      "a negative count",
      file(json => {
        json.accessors[0]!["count"] = -1;
      }),
      "accessors[0].count of the glTF is not a whole number.",
    ],
    [
      "another type",
      file(json => {
        json.accessors[0]!["type"] = "VEC2";
      }),
      "accessors[0] of the glTF holds VEC2 where 3 numbers each are wanted.",
    ],
    [
      "a vertex too many",
      file(json => {
        json.accessors[0]!["count"] = 3;
      }),
      "meshes[0].primitives[0] of the glTF names vertex 3; there are 3.",
    ],
    [
      "nodes in a loop",
      file(json => {
        json.nodes[0]!["children"] = [0];
      }),
      "The nodes of the glTF hold each other more than 256 deep.",
    ],
    [
      "nodes that double",
      file(json => {
        json.nodes = Array.from({ length: 40 }, (_, i) => (i < 39 ? { children: [i + 1, i + 1] } : {}));
      }),
      "The nodes of the glTF hold each other more than 200000 times.",
    ],
    [
      "no such mesh",
      file(json => {
        json.nodes[0]!["mesh"] = 4;
      }),
      "meshes[4] of the glTF is not there or not an object.",
    ],
    [
      "half a matrix",
      file(json => {
        json.nodes[0]!["matrix"] = [1, 2];
      }),
      "nodes[0].matrix of the glTF wants 16 finite numbers.",
    ],
    [
      "lines only",
      file(json => {
        json.meshes[0]!.primitives[0]!["mode"] = 1;
      }),
      "The file holds no faces.",
    ],
    ["a GLB cut short", bytesIn("parts.glb").subarray(0, 700), "A part of the GLB promises"],
  ])("refused: %s", (_, bytes, sentence) => {
    expect(readGltf(bytes)).toMatchObject({
      kind: "not-understood",
      sentence: expect.stringContaining(sentence) as string,
    });
  });
});

test("damaged scenes are read or refused in a sentence, never with a fault (1500 seeded cases)", () => {
  const random = seededRandom(33);
  const sources = [bytesIn("parts.dae"), bytesIn("parts.glb")];
  let refused = 0;
  for (let i = 0; i < 1500; i++) {
    const source = Uint8Array.from(sources[i % 2]!);
    const cut = random() < 0.2 ? source.subarray(0, Math.floor(random() * source.length)) : source;
    for (let n = 1 + Math.floor(random() * 4); n > 0 && cut.length > 0; n--)
      cut[Math.floor(random() * (i % 2 === 0 ? cut.length : Math.min(1500, cut.length)))] =
        i % 2 === 0 ? 32 + Math.floor(random() * 95) : Math.floor(random() * 256);
    const answer = readMesh(i % 2 === 0 ? "a.dae" : "a.glb", cut);
    if (answer.kind === "read") expect(answer.mesh.positions.every(Number.isFinite)).toBe(true);
    else {
      refused++;
      expect(answer.sentence).toMatch(/^.{10,300}[.]$/s);
    }
  }
  expect(refused).toBeGreaterThan(600);
});

test("a name without a known ending is refused", () => {
  expect(readMesh("folder.stl/part.step", new Uint8Array())).toEqual({
    kind: "not-understood",
    sentence: "part.step is no mesh that is read: STL, OBJ, PLY, DAE, GLB and glTF are.",
  });
});
