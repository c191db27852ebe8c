import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { utf8 } from "../utf8.ts";
import { shorten } from "../xml.ts";
import { count } from "./dae-geometry.ts";
import { GltfBuffers } from "./gltf-buffers.ts";
import { GltfEntry } from "./gltf-json.ts";
import { passedOver, scaled, Soup, times, moved, triangleRun, type Matrix4 } from "./placed.ts";
import { finishMesh, type MeshRead } from "./report.ts";

const GLB = 0x46546c67, JSON_CHUNK = 0x4e4f534a, BINARY_CHUNK = 0x004e4942, DEEPEST = 256, LARGEST_FILE = 512_000_000;
/** glTF is y up: y becomes z. */
const UPRIGHT: Matrix4 = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1];
/** Needed extensions that change no shape, or that are read. */
const HARMLESS = /^(KHR_materials_.*|KHR_texture_.*|KHR_lights_punctual|EXT_texture_.*|KHR_mesh_quantization|KHR_xmp.*)$/;

/**
 * Reads the surfaces of a glTF 2, binary (GLB) or JSON: every node where its matrices put it, in metres, z up. Shape only:
 * materials, skins, morphs and animations are passed over. Compressed surfaces are refused with the name of the compression.
 *
 * @param other  bytes of a file that a JSON glTF names, by its address.
 */
export function readGltf(bytes: Uint8Array, other: (address: string) => Uint8Array | undefined = () => undefined): MeshRead | NotUnderstood {
  return answering(() => {
    if (bytes.length > LARGEST_FILE) throw new Refusal(`The file has ${bytes.length} bytes; at most ${LARGEST_FILE} are read.`);
    const isBinary = bytes.length >= 4 && viewOf(bytes).getUint32(0, true) === GLB, { json, binary } = isBinary ? chunks(bytes) : { json: bytes, binary: undefined };
    const root = new GltfEntry(parsed(json), "The whole"), version = root.child("asset").text("version") ?? "";
    if (!version.startsWith("2")) throw new Refusal(`The file is glTF ${shorten(version)}; glTF 2 is read.`);
    for (const extension of root.list("extensionsRequired")) if (typeof extension !== "string" || !HARMLESS.test(extension)) throw new Refusal(`The file needs ${shorten(String(extension))}, which is not read.`);
    const scene = new Scene(root, new GltfBuffers(root, binary, other));
    scene.whole();
    return finishMesh(isBinary ? "GLB" : "glTF", scene.soup.mesh(), passedOver(scene.skipped));
  });
}

const viewOf = (bytes: Uint8Array): DataView => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

function chunks(bytes: Uint8Array): { readonly json: Uint8Array; readonly binary: Uint8Array | undefined } {
  const view = viewOf(bytes);
  let json: Uint8Array | undefined, binary: Uint8Array | undefined;
  for (let at = 12; at + 8 <= bytes.length;) {
    const length = view.getUint32(at, true), type = view.getUint32(at + 4, true), chunk = bytes.subarray(at + 8, at + 8 + length);
    if (chunk.length < length) throw new Refusal(`A part of the GLB promises ${length} bytes, but ${chunk.length} are left.`);
    if (type === JSON_CHUNK) json ??= chunk; else if (type === BINARY_CHUNK) binary ??= chunk;
    at += 8 + length;
  }
  if (!json) throw new Refusal("The GLB holds no description of what is in it.");
  return { json, binary };
}

function parsed(bytes: Uint8Array): unknown {
  try {
    return JSON.parse(utf8(bytes));
  } catch (problem) {
    if (problem instanceof SyntaxError) throw new Refusal("The file is neither a GLB nor the JSON of a glTF.");
    throw problem;
  }
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
    const hasScene = this.root.list("scenes").length > 0, scene = hasScene ? this.root.entry("scenes", this.root.whole("scene", 0)) : undefined;
    const roots = scene ? scene.list("nodes") : this.root.list("nodes").map((_, i) => i);
    for (const index of roots) this.node(index, UPRIGHT, 0);
    if (this.root.list("animations").length > 0) count(this.skipped, "animation", this.root.list("animations").length);
  }
  private node(index: unknown, outer: Matrix4, depth: number): void {
    if (typeof index !== "number") throw new Refusal("A node of the glTF is not named by its number.");
    if (depth > DEEPEST || ++this.visits > 200_000) throw new Refusal(`The nodes of the glTF hold each other ${depth > DEEPEST ? `more than ${DEEPEST} deep` : "more than 200000 times"}.`);
    const node = this.root.entry("nodes", index), matrix = times(outer, placeOf(node));
    if (node.has("skin")) count(this.skipped, "skin", 1);
    if (node.has("camera")) count(this.skipped, "camera", 1);
    if (node.has("mesh")) this.mesh(this.root.entry("meshes", node.whole("mesh")), matrix);
    for (const child of node.list("children")) this.node(child, matrix, depth + 1);
  }
  private mesh(mesh: GltfEntry, matrix: Matrix4): void {
    mesh.list("primitives").forEach((value, i) => {
      const primitive = new GltfEntry(value, `${mesh.place}.primitives[${i}]`), mode = primitive.whole("mode", 4);
      if (mode < 4) { count(this.skipped, mode === 0 ? "point set" : "line set", 1); return; }
      if (mode > 6) throw new Refusal(`${primitive.place} of the glTF has the mode ${mode}.`);
      if (primitive.has("targets")) count(this.skipped, "morph", 1);
      const attributes = primitive.child("attributes");
      if (!attributes.has("POSITION")) { count(this.skipped, "part without corners", 1); return; }
      const points = this.buffers.numbers(attributes.whole("POSITION"), 3), total = points.length / 3;
      const corners = primitive.has("indices") ? this.buffers.numbers(primitive.whole("indices"), 1) : Float64Array.from({ length: total }, (_, k) => k);
      const wrong = corners.find(corner => !(corner < total));
      if (wrong !== undefined) throw new Refusal(`${primitive.place} of the glTF names vertex ${wrong}; there are ${total}.`);
      this.soup.add(points, mode === 4 ? corners : triangleRun(mode === 5 ? "strip" : "fan", corners), matrix);
    });
  }
}

/** A node's matrix, written column by column, or its translation, rotation and scale. */
function placeOf(node: GltfEntry): Matrix4 {
  const columns = node.numbers("matrix", 16);
  if (columns) return Array.from({ length: 16 }, (_, i) => columns[4 * (i & 3) + (i >> 2)]!);
  const [tx, ty, tz] = node.numbers("translation", 3) ?? [0, 0, 0], [x, y, z, w] = node.numbers("rotation", 4) ?? [0, 0, 0, 1], [sx, sy, sz] = node.numbers("scale", 3) ?? [1, 1, 1];
  const n = 2 / (x! * x! + y! * y! + z! * z! + w! * w! || 1);
  const turn: Matrix4 = [
    1 - n * (y! * y! + z! * z!), n * (x! * y! - z! * w!), n * (x! * z! + y! * w!), 0, n * (x! * y! + z! * w!), 1 - n * (x! * x! + z! * z!), n * (y! * z! - x! * w!), 0,
    n * (x! * z! - y! * w!), n * (y! * z! + x! * w!), 1 - n * (x! * x! + y! * y!), 0, 0, 0, 0, 1,
  ];
  return times(times(moved(tx!, ty!, tz!), turn), scaled(sx!, sy!, sz!));
}
