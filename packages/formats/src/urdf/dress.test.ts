import { describe, expect, test } from "vitest";
import { armFromUrdf, fitArm, readGltfSurfaces, readUrdf, type FittedSurface, type UrdfChain } from "../index.ts";

const link = (name: string): string =>
  `<link name="${name}"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>`;
const joint = (name: string, parent: string, child: string, xyz: string, rpy: string): string =>
  `<joint name="${name}" type="revolute"><parent link="${parent}"/><child link="${child}"/><origin xyz="${xyz}" rpy="${rpy}"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint>`;
const URDF = `<robot name="two">${["base_link", "Upper Arm", "hand"].map(link).join("")}${joint("a", "base_link", "Upper Arm", "0 0 0.5", "0 0 1.5707963267948966")}${joint("b", "Upper Arm", "hand", "0.3 0 0", "0 1.5707963267948966 0")}</robot>`;

function chainOf(): UrdfChain {
  const robot = readUrdf(URDF);
  if (robot.kind !== "read") throw new Error(robot.sentence);
  const chain = armFromUrdf(robot.robot);
  if (chain.kind !== "chain") throw new Error(chain.sentence);
  return chain;
}

/**
 * A triangle whose first corner is at the given place in the world (y up in the file), in nested nodes, with a picture.
 */
const PNG = Uint8Array.of(137, 80, 78, 71, 13, 10, 26, 10);
function gltf(change: (whole: Record<string, unknown[]>) => void = () => undefined): Uint8Array {
  const corners = new Float32Array([0, 0, 0, 0.1, 0, 0, 0, 0.1, 0]);
  const uv = new Float32Array([0, 0, 1, 0, 0, 1]);
  const bytes = Buffer.concat([Buffer.from(corners.buffer), Buffer.from(uv.buffer), Buffer.from(PNG)]);
  const whole = {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [
      { name: "Robot", children: [1, 3] },
      { name: "upper_arm.001", translation: [0, 0.5, 0], children: [2] },
      { name: "shell", mesh: 0 },
      { name: "logo", mesh: 1, translation: [0, 2, 0] },
    ],
    meshes: [
      { primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 }, material: 0 }] },
      { primitives: [{ attributes: { POSITION: 0 }, material: 1 }] },
    ],
    materials: [
      { pbrMetallicRoughness: { baseColorTexture: { index: 0 } } },
      { pbrMetallicRoughness: { baseColorFactor: [1, 0.5, 0, 1] } },
    ],
    textures: [{ source: 0 }],
    images: [{ bufferView: 2, mimeType: "image/png" }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 3, type: "VEC3" },
      { bufferView: 1, componentType: 5126, count: 3, type: "VEC2" },
    ],
    bufferViews: [
      { buffer: 0, byteLength: 36 },
      { buffer: 0, byteOffset: 36, byteLength: 24 },
      { buffer: 0, byteOffset: 60, byteLength: 8 },
    ],
    buffers: [{ uri: `data:application/octet-stream;base64,${bytes.toString("base64")}`, byteLength: bytes.length }],
  };
  change(whole as unknown as Record<string, unknown[]>);
  return new TextEncoder().encode(JSON.stringify(whole));
}
function surfacesOf(bytes: Uint8Array): readonly FittedSurface[] {
  const answer = readGltfSurfaces(bytes);
  if (answer.kind !== "read") throw new Error(answer.sentence);
  return answer.surfaces;
}

describe("L-09 a glTF robot dresses the URDF robot and is gone", () => {
  test("a surface goes to the link its node is named after, at the place where it stood with all joints at zero", () => {
    const { surfaces, bare, spare } = fitArm(chainOf(), surfacesOf(gltf()));
    expect(surfaces).toHaveLength(1);
    expect(surfaces[0]).toMatchObject({
      link: 1,
      name: "Upper Arm",
      color: [1, 1, 1, 1],
      picture: { mime: "image/png", bytes: PNG },
    });
    expect([...surfaces[0]!.uv!]).toEqual([0, 0, 1, 0, 0, 1]);
    // In the world the corners are (0, 0, 0.5), (0.1, 0, 0.5), (0, 0, 0.6); link 1 stands at 0.5 m, turned by 90° about
    // z.
    [0, 0, 0, 0, -0.1, 0, 0, 0, 0.1].forEach((value, i) => {
      expect(surfaces[0]!.positions[i]).toBeCloseTo(value, 7);
    });
    expect(bare).toEqual(["base_link", "hand"]);
    expect(spare).toEqual(["logo"]);
  });
  test("colours without a picture are read; a surface on no link is left out, not left standing", () => {
    const surfaces = surfacesOf(gltf());
    expect(surfaces.map(({ nodes, color }) => [nodes[0], color])).toEqual([
      ["shell", [1, 1, 1, 1]],
      ["logo", [1, 0.5, 0, 1]],
    ]);
    expect(fitArm(chainOf(), []).surfaces).toEqual([]);
  });
  test.each<[string, (whole: Record<string, unknown[]>) => void, string]>([
    [
      "a picture beyond its buffer",
      whole => {
        (whole.bufferViews![2] as { byteLength: number }).byteLength = 99;
      },
      "images[0] of the glTF reaches beyond its buffer.",
    ],
    [
      "a picture that is not there",
      whole => {
        whole.images = [{ uri: "paint.png" }];
      },
      "paint.png is missing.",
    ],
    [
      "places on the picture for other corners",
      whole => {
        (whole.accessors![1] as { count: number }).count = 2;
      },
      "meshes[0].primitives[0] of the glTF has 2 places on its picture for 3 corners.",
    ],
    [
      "nodes in a ring",
      whole => {
        (whole.nodes![2] as { children: number[] }).children = [1];
      },
      "The nodes of the glTF hold each other more than 256 deep.",
    ],
  ])("refused: %s", (_, change, sentence) => {
    expect(readGltfSurfaces(gltf(change))).toMatchObject({ kind: "not-understood", sentence });
  });
});
