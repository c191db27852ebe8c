import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { expect, test } from "vitest";
import { withoutNormalMaps } from "../../../vite-glb.ts";

const profiles = join(
  dirname(createRequire(import.meta.url).resolve("@webxr-input-profiles/assets/package.json")),
  "dist/profiles",
);
interface Gltf {
  readonly bufferViews: readonly { readonly byteOffset?: number; readonly byteLength: number }[];
  readonly buffers: readonly { readonly byteLength: number }[];
  readonly accessors: readonly { readonly bufferView: number }[];
  readonly materials: readonly Readonly<Record<string, unknown>>[];
}
function chunksOf(file: Buffer): { readonly gltf: Gltf; readonly binary: Buffer } {
  expect(file.readUInt32LE(8)).toBe(file.length);
  const json = file.readUInt32LE(12);
  const gltf = JSON.parse(file.toString("utf8", 20, 20 + json)) as Gltf;
  const binary = file.subarray(20 + json + 8);
  expect(binary.length).toBe(file.readUInt32LE(20 + json));
  expect(gltf.buffers[0]!.byteLength).toBeLessThanOrEqual(binary.length);
  return { gltf, binary };
}
const bytesOf = ({ gltf, binary }: ReturnType<typeof chunksOf>, view: number): Buffer => {
  const { byteOffset = 0, byteLength } = gltf.bufferViews[view]!;
  return binary.subarray(byteOffset, byteOffset + byteLength);
};

test.each(["generic-trigger/left.glb", "generic-trigger-squeeze-thumbstick/right.glb"])(
  "the model %s is drawn from the same corners and colours with less than half the bytes",
  name => {
    const whole = readFileSync(join(profiles, name));
    const light = withoutNormalMaps(whole);
    expect(light.length).toBeLessThan(whole.length / 2);
    const [before, after] = [chunksOf(whole), chunksOf(light)];
    expect(after.gltf.accessors).toEqual(before.gltf.accessors);
    for (const { bufferView } of before.gltf.accessors)
      expect(bytesOf(after, bufferView).equals(bytesOf(before, bufferView))).toBe(true);
    expect(after.gltf.materials).toEqual(before.gltf.materials.map(({ normalTexture: _, ...rest }) => rest));
  },
);

test("a model without maps of normals, and what is no model, stay as they are", () => {
  const hand = readFileSync(join(profiles, "generic-hand/left.glb"));
  expect(withoutNormalMaps(hand)).toBe(hand);
  const text = Buffer.from("no model");
  expect(withoutNormalMaps(text)).toBe(text);
});
