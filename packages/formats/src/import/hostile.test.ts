import fc from "fast-check";
import { deflateRawSync, inflateRawSync } from "node:zlib";
import { describe, expect, test } from "vitest";
import { boxMesh } from "@twincell/core";
import { filesInMemory } from "../files/source.ts";
import { readZip, ZIP_LIMITS } from "../files/zip.ts";
import { writeStl } from "../mesh/stl.ts";
import { importFile } from "./import-file.ts";
import { writeGlb } from "./write-glb.ts";

const bytesOf = (text: string): Uint8Array => new TextEncoder().encode(text);
const answerTo = (name: string, bytes: Uint8Array) =>
  importFile(name, filesInMemory(new Map([[name, bytes]])), {
    readStep: () => ({ success: false }),
  });
const inflate = (packed: Uint8Array, size: number): Uint8Array => inflateRawSync(packed, { maxOutputLength: size + 1 });

const stl = writeStl(boxMesh([0.1, 0.2, 0.3]));
const claims = new Uint8Array(stl);
new DataView(claims.buffer).setUint32(80, 1_000_000_000, true);
const ply = (vertices: number, adapters: number): string =>
  `ply\nformat ascii 1.0\nelement vertex ${vertices}\nproperty float x\nproperty float y\nproperty float z\nelement face ${adapters}\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n`;
const gltf = (count: number): string =>
  JSON.stringify({
    asset: { version: "2.0" },
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    accessors: [{ componentType: 5126, count, type: "VEC3" }],
  });

describe("a hostile or broken file is one sentence within 2 s", () => {
  test.each<readonly [what: string, name: string, content: Uint8Array | string, says: RegExp]>([
    ["nothing", "a.stl", "", /is empty/],
    ["10⁹ facets claimed", "a.stl", claims, /promises 1000000000 triangles/],
    ["an STL cut off", "a.stl", stl.subarray(0, 300), /promises 12 triangles/],
    ["10⁹ vertices claimed", "a.ply", ply(1_000_000_000, 1), /promises 1000000000 elements/],
    ["a PLY cut off", "a.ply", ply(30, 1), /The file ends inside its data|element/],
    ["10⁹ elements without bytes", "a.gltf", gltf(1_000_000_000), /at most/],
    ["15 million elements without bytes", "a.gltf", gltf(15_000_000), /no bytes for them/],
    [
      "a GLB cut off",
      "a.glb",
      writeGlb([{ name: "a", path: [], color: "#ffffff", mesh: boxMesh([1, 1, 1]) }]).subarray(0, 700),
      /promises|beyond/,
    ],
    ["entities", "a.dae", '<!DOCTYPE a [<!ENTITY b "cccc">]><COLLADA>&b;</COLLADA>', /entities/],
    ["entities in a robot", "a.urdf", '<!DOCTYPE a [<!ENTITY b "cccc">]><robot name="&b;"/>', /entities/],
    ["only NaN", "a.obj", "v nan nan nan\nv inf 0 0\nv 0 0 0\nf 1 2 3\n", /No triangle/],
    ["only triangles without area", "a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", /No triangle/],
    ["no STEP", "a.step", "solid a", /ISO-10303-21/],
    ["a STEP cut off", "a.stp", "ISO-10303-21;\nHEADER;", /CAD kernel/],
    ["elements nested deeply", "a.dae", "<COLLADA>".repeat(100_000), /nested/],
  ])("%s", (_, name, content, says) => {
    const before = performance.now();
    const answer = answerTo(name, typeof content === "string" ? bytesOf(content) : content);
    expect(answer).toMatchObject({ kind: "not-understood", sentence: expect.stringMatching(says) as string });
    expect(performance.now() - before).toBeLessThan(2000);
  });
});

/** A ZIP with one entry, whose directory may lie. */
function zip(
  name: string,
  content: Uint8Array,
  lies: { readonly size?: number; readonly flags?: number } = {},
): Uint8Array {
  const packed = deflateRawSync(content);
  const title = bytesOf(name);
  const out = new Uint8Array(30 + title.length + packed.length + 46 + title.length + 22);
  const view = new DataView(out.buffer);
  view.setUint32(0, 0x04034b50, true);
  view.setUint16(26, title.length, true);
  out.set(title, 30);
  out.set(packed, 30 + title.length);
  const at = 30 + title.length + packed.length;
  view.setUint32(at, 0x02014b50, true);
  view.setUint16(at + 8, lies.flags ?? 0, true);
  view.setUint16(at + 10, 8, true);
  view.setUint32(at + 20, packed.length, true);
  view.setUint32(at + 24, lies.size ?? content.length, true);
  view.setUint16(at + 28, title.length, true);
  out.set(title, at + 46);
  const end = at + 46 + title.length;
  view.setUint32(end, 0x06054b50, true);
  view.setUint16(end + 10, 1, true);
  view.setUint32(end + 16, at, true);
  return out;
}

describe("archives", () => {
  test("a file comes out as it went in", () => {
    const answer = readZip(zip("meshes/a.stl", stl), inflate);
    expect(answer.kind === "read" && Buffer.from(answer.files.get("meshes/a.stl")!).equals(Buffer.from(stl))).toBe(
      true,
    );
  });
  test.each<readonly [string, Uint8Array, RegExp]>([
    ["a bomb that says its size", zip("a.stl", new Uint8Array(60_000_000)), /would grow from/],
    [
      "a bomb that says it is small",
      zip("a.stl", new Uint8Array(60_000_000), { size: 1000 }),
      /damaged|where the archive says/,
    ],
    ["more than fits", zip("a.stl", stl, { size: ZIP_LIMITS.bytes + 1 }), /more than/],
    ["a path that climbs", zip("../../etc/passwd", stl), /leads out of its folder/],
    ["a path from the root", zip("/etc/passwd", stl), /leads out of its folder/],
    ["a path of another drive", zip("C:\\a.stl", stl), /leads out of its folder/],
    ["an encrypted file", zip("a.stl", stl, { flags: 1 }), /encrypted/],
    ["no archive", stl, /no ZIP archive/],
    ["an archive cut off", zip("a.stl", stl).subarray(0, 100), /no ZIP archive/],
  ])("%s is refused with a sentence within 2 s", (_, bytes, says) => {
    const before = performance.now();
    expect(readZip(bytes, inflate)).toMatchObject({
      kind: "not-understood",
      sentence: expect.stringMatching(says) as string,
    });
    expect(performance.now() - before).toBeLessThan(2000);
  });
});

/** Sound files that are spoilt at random. */
const seeds: readonly (readonly [string, Uint8Array])[] = [
  ["a.stl", stl],
  [
    "a.stl",
    bytesOf(
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
    ),
  ],
  ["a.obj", bytesOf("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\no b\nusemtl c\nf 1 2 4 3\n")],
  ["a.ply", bytesOf(ply(3, 1))],
  ["a.glb", writeGlb([{ name: "a", path: ["b"], color: "#123456", mesh: boxMesh([1, 1, 1]) }])],
  ["a.gltf", bytesOf(gltf(3))],
  [
    "a.dae",
    bytesOf(
      '<COLLADA><asset><unit meter="1"/></asset><library_geometries><geometry id="g"><mesh><source id="s"><float_array>0 0 0 1 0 0 0 1 0</float_array></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries></COLLADA>',
    ),
  ],
  [
    "a.urdf",
    bytesOf('<robot name="a"><link name="b"><visual><geometry><box size="1 1 1"/></geometry></visual></link></robot>'),
  ],
];

test.each(seeds)("%s number %#, spoilt in 400 ways, is parts or a sentence, never a crash", (name, sound) => {
  expect(answerTo(name, sound).kind).toBe(name === "a.gltf" ? "not-understood" : "imported");
  fc.assert(
    fc.property(
      fc.array(fc.tuple(fc.nat(sound.length - 1), fc.nat(255)), { maxLength: 6 }),
      fc.integer({ min: 0, max: sound.length }),
      fc.boolean(),
      (changes, length, isCut) => {
        const bytes = Uint8Array.from(isCut ? sound.subarray(0, length) : sound);
        for (const [at, value] of changes) if (at < bytes.length) bytes[at] = value;
        const answer = answerTo(name, bytes);
        if (answer.kind === "imported") {
          for (const side of answer.report.size_m) expect(Number.isFinite(side)).toBe(true);
          expect(answer.report.triangles).toBeGreaterThan(0);
        } else expect(answer.sentence).toMatch(/\S.*[.?]$/s);
      },
    ),
    { numRuns: 400, seed: 20261123 },
  );
});

test("a ZIP spoilt in 400 ways is files or a sentence", () => {
  const sound = zip("a/b.stl", stl);
  fc.assert(
    fc.property(fc.array(fc.tuple(fc.nat(sound.length - 1), fc.nat(255)), { minLength: 1, maxLength: 6 }), changes => {
      const bytes = Uint8Array.from(sound);
      for (const [at, value] of changes) bytes[at] = value;
      expect(["read", "not-understood"]).toContain(readZip(bytes, inflate).kind);
    }),
    { numRuns: 400, seed: 20261123 },
  );
});
