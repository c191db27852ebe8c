import { Refusal } from "../refusal.ts";
import { utf8 } from "../utf8.ts";
import { shorten } from "../xml.ts";
import { GltfBuffers } from "./gltf-buffers.ts";
import { GltfEntry } from "./gltf-json.ts";
import { moved, scaled, times, triangleRun, type Matrix4 } from "./placed.ts";

const GLB = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BINARY_CHUNK = 0x004e4942;
const LARGEST_FILE = 512_000_000;
/** glTF is y up: y becomes z. */
export const UPRIGHT: Matrix4 = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1];
/** Needed extensions that change no shape, or that are read. */
const HARMLESS =
  /^(KHR_materials_.*|KHR_texture_.*|KHR_lights_punctual|EXT_texture_.*|KHR_mesh_quantization|KHR_xmp.*)$/;

/**
 * A glTF 2 ready to be asked.
 *
 * @throws {Refusal} for anything else, and for compressed surfaces, with the name of the compression.
 */
export function openGltf(
  bytes: Uint8Array,
  other: (address: string) => Uint8Array | undefined,
): { readonly root: GltfEntry; readonly buffers: GltfBuffers; readonly isBinary: boolean } {
  if (bytes.length > LARGEST_FILE)
    throw new Refusal(`The file has ${bytes.length} bytes; at most ${LARGEST_FILE} are read.`);
  const isBinary = bytes.length >= 4 && viewOf(bytes).getUint32(0, true) === GLB;
  const { json, binary } = isBinary ? chunks(bytes) : { json: bytes, binary: undefined };
  const root = new GltfEntry(parsed(json), "The whole");
  const version = root.child("asset").text("version") ?? "";
  if (!version.startsWith("2")) throw new Refusal(`The file is glTF ${shorten(version)}; glTF 2 is read.`);
  for (const extension of root.list("extensionsRequired"))
    if (typeof extension !== "string" || !HARMLESS.test(extension))
      throw new Refusal(`The file needs ${shorten(String(extension))}, which is not read.`);
  return { root, buffers: new GltfBuffers(root, binary, other), isBinary };
}

/** The nodes the shown scene begins with. */
export function rootNodes(root: GltfEntry): readonly unknown[] {
  const hasScene = root.list("scenes").length > 0;
  return hasScene ? root.entry("scenes", root.whole("scene", 0)).list("nodes") : root.list("nodes").map((_, i) => i);
}

/** Corners of a primitive of triangles, strips or fans, three per triangle. @param total  vertices there are. */
export function triangleCorners(primitive: GltfEntry, buffers: GltfBuffers, total: number): ArrayLike<number> {
  const mode = primitive.whole("mode", 4);
  const corners = primitive.has("indices")
    ? buffers.numbers(primitive.whole("indices"), 1)
    : Float64Array.from({ length: total }, (_, k) => k);
  const wrong = corners.find(corner => !(corner < total));
  if (wrong !== undefined)
    throw new Refusal(`${primitive.place} of the glTF names vertex ${wrong}; there are ${total}.`);
  return mode === 4 ? corners : triangleRun(mode === 5 ? "strip" : "fan", corners);
}

const viewOf = (bytes: Uint8Array): DataView => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

function chunks(bytes: Uint8Array): { readonly json: Uint8Array; readonly binary: Uint8Array | undefined } {
  const view = viewOf(bytes);
  let json: Uint8Array | undefined;
  let binary: Uint8Array | undefined;
  for (let at = 12; at + 8 <= bytes.length; ) {
    const length = view.getUint32(at, true);
    const type = view.getUint32(at + 4, true);
    const chunk = bytes.subarray(at + 8, at + 8 + length);
    if (chunk.length < length)
      throw new Refusal(`A part of the GLB promises ${length} bytes, but ${chunk.length} are left.`);
    if (type === JSON_CHUNK) json ??= chunk;
    else if (type === BINARY_CHUNK) binary ??= chunk;
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

/** A node's matrix, written column by column, or its translation, rotation and scale. */
export function placeOf(node: GltfEntry): Matrix4 {
  const columns = node.numbers("matrix", 16);
  if (columns) return Array.from({ length: 16 }, (_, i) => columns[4 * (i & 3) + (i >> 2)]!);
  const [tx, ty, tz] = node.numbers("translation", 3) ?? [0, 0, 0];
  const [x, y, z, w] = node.numbers("rotation", 4) ?? [0, 0, 0, 1];
  const [sx, sy, sz] = node.numbers("scale", 3) ?? [1, 1, 1];
  const n = 2 / (x! * x! + y! * y! + z! * z! + w! * w! || 1);
  const turn: Matrix4 = [
    1 - n * (y! * y! + z! * z!),
    n * (x! * y! - z! * w!),
    n * (x! * z! + y! * w!),
    0,
    n * (x! * y! + z! * w!),
    1 - n * (x! * x! + z! * z!),
    n * (y! * z! - x! * w!),
    0,
    n * (x! * z! - y! * w!),
    n * (y! * z! + x! * w!),
    1 - n * (x! * x! + y! * y!),
    0,
    0,
    0,
    0,
    1,
  ];
  return times(times(moved(tx!, ty!, tz!), turn), scaled(sx!, sy!, sz!));
}
