import { meshBounds } from "@twincell/core";
import type { ImportedPart } from "./part.ts";

/**
 * Parts as a binary glTF 2: a node, a mesh and colour each, in metres, y up as the format has it. The assembly's names
 * above a part become nodes above it.
 *
 * @see Khronos glTF 2.0, 4.4
 */
export function writeGlb(parts: readonly ImportedPart[]): Uint8Array {
  const chunks: Uint8Array[] = [];
  let bytes = 0;
  const accessors: object[] = [];
  const bufferViews: object[] = [];
  const add = (data: Uint8Array, target: number, accessor: object): number => {
    bufferViews.push({ buffer: 0, byteOffset: bytes, byteLength: data.length, target });
    accessors.push({ bufferView: bufferViews.length - 1, ...accessor });
    chunks.push(data);
    bytes += data.length;
    return accessors.length - 1;
  };
  const colors = [...new Set(parts.map(({ color }) => color))];
  const meshes: object[] = [];
  const nodes = new Nodes();
  for (const { name, path, color, mesh } of parts) {
    const position = add(floats(mesh.positions), 34_962, {
      componentType: 5126,
      count: mesh.positions.length / 3,
      type: "VEC3",
      min: rounded(meshBounds(mesh).lower),
      max: rounded(meshBounds(mesh).upper),
    });
    const indices = add(wholeNumbers(mesh.indices), 34_963, {
      componentType: 5125,
      count: mesh.indices.length,
      type: "SCALAR",
    });
    meshes.push({
      name,
      primitives: [{ attributes: { POSITION: position }, indices, material: colors.indexOf(color) }],
    });
    nodes.add(name, path, meshes.length - 1);
  }
  const json = {
    asset: { version: "2.0", generator: "Twincell" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: nodes.list,
    meshes,
    materials: colors.map(color => ({
      name: color,
      pbrMetallicRoughness: { baseColorFactor: linear(color), metallicFactor: 0.05, roughnessFactor: 0.62 },
    })),
    accessors,
    bufferViews,
    buffers: [{ byteLength: bytes }],
  };
  return container(json, chunks, bytes);
}

/** Corners are rounded to 32 bits, and a reader compares: the bounds are rounded alike. */
const rounded = (corner: readonly number[]): number[] => corner.map(Math.fround);

interface Node {
  readonly name: string;
  readonly mesh?: number;
  readonly rotation?: readonly number[];
  children?: number[];
}

class Nodes {
  /** The first turns z up into y up. */
  readonly list: Node[] = [{ name: "z up", rotation: [-Math.SQRT1_2, 0, 0, Math.SQRT1_2], children: [] }];
  readonly #above = new Map<string, number>([["[]", 0]]);

  add(name: string, path: readonly string[], mesh: number): void {
    this.#under(path, { name, mesh });
  }
  #under(path: readonly string[], node: Node): number {
    const parent = this.list[this.#place(path)]!;
    this.list.push(node);
    parent.children = [...(parent.children ?? []), this.list.length - 1];
    return this.list.length - 1;
  }
  #place(path: readonly string[]): number {
    const key = JSON.stringify(path);
    const known = this.#above.get(key);
    if (known !== undefined) return known;
    const made = this.#under(path.slice(0, -1), { name: path.at(-1) ?? "" });
    this.#above.set(key, made);
    return made;
  }
}

function floats(values: Float64Array): Uint8Array {
  const view = new DataView(new ArrayBuffer(4 * values.length));
  values.forEach((value, i) => view.setFloat32(4 * i, value, true));
  return new Uint8Array(view.buffer);
}
function wholeNumbers(values: Uint32Array): Uint8Array {
  const view = new DataView(new ArrayBuffer(4 * values.length));
  values.forEach((value, i) => view.setUint32(4 * i, value, true));
  return new Uint8Array(view.buffer);
}

/** `#rrggbb` as linear numbers with opacity. IEC 61966-2-1. */
function linear(color: string): number[] {
  const channels = [1, 3, 5].map(at => Number.parseInt(color.slice(at, at + 2), 16) / 255);
  return [...channels.map(value => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4)), 1];
}

function container(json: object, chunks: readonly Uint8Array[], binaryLength: number): Uint8Array {
  const text = asciiBytes(JSON.stringify(json));
  const jsonLength = Math.ceil(text.length / 4) * 4;
  const out = new Uint8Array(12 + 8 + jsonLength + 8 + binaryLength);
  const view = new DataView(out.buffer);
  view.setUint32(0, 0x46546c67, true);
  view.setUint32(4, 2, true);
  view.setUint32(8, out.length, true);
  view.setUint32(12, jsonLength, true);
  view.setUint32(16, 0x4e4f534a, true);
  out.fill(0x20, 20, 20 + jsonLength);
  out.set(text, 20);
  view.setUint32(20 + jsonLength, binaryLength, true);
  view.setUint32(24 + jsonLength, 0x004e4942, true);
  let at = 28 + jsonLength;
  for (const chunk of chunks) {
    out.set(chunk, at);
    at += chunk.length;
  }
  return out;
}

/** JSON in plain ASCII: other letters as \uXXXX. */
const asciiBytes = (text: string): Uint8Array =>
  Uint8Array.from(
    text.replace(/[\u0080-\uffff]/g, letter => `\\u${letter.charCodeAt(0).toString(16).padStart(4, "0")}`),
    letter => letter.charCodeAt(0),
  );
