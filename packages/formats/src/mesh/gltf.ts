import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { count } from "./dae-geometry.ts";
import type { GltfBuffers } from "./gltf-buffers.ts";
import { GltfEntry } from "./gltf-json.ts";
import { openGltf, placeOf, rootNodes, triangleCorners, UPRIGHT } from "./gltf-open.ts";
import { passedOver, Soup, times, type Matrix4 } from "./placed.ts";
import { finishMesh, type MeshRead } from "./report.ts";

const DEEPEST = 256;

/**
 * Reads the surfaces of a glTF 2, binary (GLB) or JSON: every node where its matrices put it, in metres, z up. Shape
 * only: materials, skins, morphs and animations are passed over. Compressed surfaces are refused with the name of the
 * compression.
 *
 * @param other  bytes of a file that a JSON glTF names, by its address.
 */
export function readGltf(
  bytes: Uint8Array,
  other: (address: string) => Uint8Array | undefined = () => undefined,
): MeshRead | NotUnderstood {
  return answering(() => {
    const { root, buffers, isBinary } = openGltf(bytes, other);
    const scene = new Scene(root, buffers);
    scene.whole();
    return finishMesh(isBinary ? "GLB" : "glTF", scene.soup.mesh(), passedOver(scene.skipped));
  });
}

class Scene {
  readonly soup = new Soup();
  readonly skipped = new Map<string, number>();
  private readonly root: GltfEntry;
  private readonly buffers: GltfBuffers;
  private visits = 0;
  constructor(root: GltfEntry, buffers: GltfBuffers) {
    this.root = root;
    this.buffers = buffers;
  }

  whole(): void {
    for (const index of rootNodes(this.root)) this.node(index, UPRIGHT, 0);
    if (this.root.list("animations").length > 0) count(this.skipped, "animation", this.root.list("animations").length);
  }
  private node(index: unknown, outer: Matrix4, depth: number): void {
    if (typeof index !== "number") throw new Refusal("A node of the glTF is not named by its number.");
    if (depth > DEEPEST || ++this.visits > 200_000)
      throw new Refusal(
        `The nodes of the glTF hold each other ${depth > DEEPEST ? `more than ${DEEPEST} deep` : "more than 200000 times"}.`,
      );
    const node = this.root.entry("nodes", index);
    const matrix = times(outer, placeOf(node));
    if (node.has("skin")) count(this.skipped, "skin", 1);
    if (node.has("camera")) count(this.skipped, "camera", 1);
    if (node.has("mesh")) this.mesh(this.root.entry("meshes", node.whole("mesh")), matrix);
    for (const child of node.list("children")) this.node(child, matrix, depth + 1);
  }
  private mesh(mesh: GltfEntry, matrix: Matrix4): void {
    mesh.list("primitives").forEach((value, i) => {
      const primitive = new GltfEntry(value, `${mesh.place}.primitives[${i}]`);
      const mode = primitive.whole("mode", 4);
      if (mode < 4) {
        count(this.skipped, mode === 0 ? "point set" : "line set", 1);
        return;
      }
      if (mode > 6) throw new Refusal(`${primitive.place} of the glTF has the mode ${mode}.`);
      if (primitive.has("targets")) count(this.skipped, "morph", 1);
      const attributes = primitive.child("attributes");
      if (!attributes.has("POSITION")) {
        count(this.skipped, "part without corners", 1);
        return;
      }
      const points = this.buffers.numbers(attributes.whole("POSITION"), 3);
      this.soup.add(points, triangleCorners(primitive, this.buffers, points.length / 3), matrix);
    });
  }
}
