import { Refusal } from "../refusal.ts";
import { shorten } from "../xml.ts";
import type { GltfEntry } from "./gltf-json.ts";

/** Bytes, reader and largest value of the component types of glTF. */
const COMPONENTS = new Map<
  number,
  { readonly size: number; readonly largest: number; readonly read: (view: DataView, at: number) => number }
>([
  [5120, { size: 1, largest: 127, read: (view, at) => view.getInt8(at) }],
  [5121, { size: 1, largest: 255, read: (view, at) => view.getUint8(at) }],
  [5122, { size: 2, largest: 32767, read: (view, at) => view.getInt16(at, true) }],
  [5123, { size: 2, largest: 65535, read: (view, at) => view.getUint16(at, true) }],
  [5125, { size: 4, largest: 2 ** 32 - 1, read: (view, at) => view.getUint32(at, true) }],
  [5126, { size: 4, largest: 1, read: (view, at) => view.getFloat32(at, true) }],
]);
const WIDTHS: Readonly<Record<string, number>> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
const MOST = 60_000_000;
/** A few words in a file must not take hundreds of megabytes: elements that are all 0 have no bytes. */
const MOST_WITHOUT_BYTES = 3_000_000;

/** The numbers behind the accessors of a glTF. */
export class GltfBuffers {
  private readonly root: GltfEntry;
  private readonly binary: Uint8Array | undefined;
  private readonly other: (address: string) => Uint8Array | undefined;
  private readonly buffers = new Map<number, Uint8Array>();
  private readonly read = new Map<number, Float64Array>();
  constructor(root: GltfEntry, binary: Uint8Array | undefined, other: (address: string) => Uint8Array | undefined) {
    this.root = root;
    this.binary = binary;
    this.other = other;
  }

  /** All numbers of an accessor, one element after the other. @param width  numbers per element it must have. */
  numbers(index: number, width: number): Float64Array {
    const known = this.read.get(index);
    if (known) return known;
    const accessor = this.root.entry("accessors", index);
    const count = accessor.whole("count");
    const given = WIDTHS[accessor.text("type") ?? ""];
    if (given !== width)
      throw new Refusal(
        `${accessor.place} of the glTF holds ${shorten(accessor.text("type") ?? "nothing")} where ${width === 1 ? "single numbers" : `${width} numbers each`} are wanted.`,
      );
    if (count * width > MOST)
      throw new Refusal(`${accessor.place} of the glTF has ${count} elements; at most ${MOST / width} are read.`);
    if (!accessor.has("bufferView") && count * width > MOST_WITHOUT_BYTES)
      throw new Refusal(`${accessor.place} of the glTF promises ${count} elements and has no bytes for them.`);
    const numbers = accessor.has("bufferView")
      ? this.elements(accessor, accessor.whole("componentType"), count, width)
      : new Float64Array(count * width);
    if (accessor.has("sparse")) this.overlay(accessor.child("sparse"), accessor, numbers, width);
    this.read.set(index, numbers);
    return numbers;
  }

  /** The bytes of a buffer view, or of a file: an image. */
  image(image: GltfEntry): Uint8Array {
    const address = image.text("uri");
    if (address !== undefined) {
      const bytes = address.startsWith("data:") ? fromBase64(address) : this.other(address);
      if (!bytes) throw new Refusal(`${shorten(address)} is missing.`);
      return bytes;
    }
    const view = this.root.entry("bufferViews", image.whole("bufferView"));
    const buffer = this.buffer(view.whole("buffer"));
    const start = view.whole("byteOffset", 0);
    const length = view.whole("byteLength");
    if (start + length > buffer.length) throw new Refusal(`${image.place} of the glTF reaches beyond its buffer.`);
    return buffer.subarray(start, start + length);
  }

  private elements(
    from: GltfEntry,
    componentType: number,
    count: number,
    width: number,
    isNormalized = from.isTrue("normalized"),
  ): Float64Array {
    const component = COMPONENTS.get(componentType);
    const bufferView = this.root.entry("bufferViews", from.whole("bufferView"));
    if (!component) throw new Refusal(`${from.place} of the glTF has the component type ${componentType}.`);
    if (bufferView.has("extensions") && bufferView.child("extensions").has("EXT_meshopt_compression"))
      throw new Refusal("The file needs EXT_meshopt_compression, which is not read.");
    const buffer = this.buffer(bufferView.whole("buffer"));
    const start = bufferView.whole("byteOffset", 0);
    const length = bufferView.whole("byteLength");
    const stride = bufferView.whole("byteStride", 0) || component.size * width;
    const first = from.whole("byteOffset", 0);
    const last = first + Math.max(0, count - 1) * stride + (count > 0 ? component.size * width : 0);
    if (last > length || start + length > buffer.length)
      throw new Refusal(`${from.place} of the glTF reaches beyond its buffer.`);
    const view = new DataView(buffer.buffer, buffer.byteOffset + start, length);
    const numbers = new Float64Array(count * width);
    for (let i = 0; i < count; i++) {
      for (let k = 0; k < width; k++) {
        const value = component.read(view, first + i * stride + k * component.size);
        numbers[i * width + k] = isNormalized ? Math.max(-1, value / component.largest) : value;
      }
    }
    return numbers;
  }

  private overlay(sparse: GltfEntry, accessor: GltfEntry, numbers: Float64Array, width: number): void {
    const count = sparse.whole("count");
    const indices = sparse.child("indices");
    if (count * width > numbers.length)
      throw new Refusal(`${sparse.place} of the glTF replaces ${count} elements of ${numbers.length / width}.`);
    const at = this.elements(indices, indices.whole("componentType"), count, 1, false);
    const values = this.elements(
      sparse.child("values"),
      accessor.whole("componentType"),
      count,
      width,
      accessor.isTrue("normalized"),
    );
    at.forEach((element, i) => {
      if (element * width >= numbers.length)
        throw new Refusal(`${sparse.place} of the glTF replaces element ${element} of ${numbers.length / width}.`);
      for (let k = 0; k < width; k++) numbers[element * width + k] = values[i * width + k]!;
    });
  }

  private buffer(index: number): Uint8Array {
    const known = this.buffers.get(index);
    if (known) return known;
    const address = this.root.entry("buffers", index).text("uri");
    const bytes =
      address === undefined
        ? index === 0
          ? this.binary
          : undefined
        : address.startsWith("data:")
          ? fromBase64(address)
          : this.other(address);
    if (!bytes)
      throw new Refusal(
        address === undefined ? "The glTF holds no bytes of its own." : `${shorten(address)} is missing.`,
      );
    this.buffers.set(index, bytes);
    return bytes;
  }
}

const LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

function fromBase64(address: string): Uint8Array {
  const comma = address.indexOf(",");
  if (!/;base64$/.test(address.slice(0, comma)))
    throw new Refusal("A buffer of the glTF is neither a file nor base64.");
  const text = address.slice(comma + 1).replace(/=+$/, "");
  const bytes = new Uint8Array(Math.floor((text.length * 3) / 4));
  let held = 0;
  let bits = 0;
  let at = 0;
  for (let i = 0; i < text.length; i++) {
    const value = LETTERS.indexOf(text.charAt(i));
    if (value < 0) throw new Refusal("A buffer of the glTF is no base64.");
    held = ((held << 6) | value) & 0xffff;
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes[at++] = (held >> bits) & 0xff;
    }
  }
  return bytes;
}
