import { compress, decompress, init } from "@bokuweb/zstd-wasm";
import { frameContentSize, LARGEST_CHUNK, type Packing } from "../packing.ts";

/** Above it chunks of joint angles hardly get smaller. */
const LEVEL = 3;
const OWN = (bytes: Uint8Array): Uint8Array<ArrayBuffer> =>
  bytes.buffer instanceof ArrayBuffer ? (bytes as Uint8Array<ArrayBuffer>) : Uint8Array.from(bytes);

const packing: Packing = {
  name: "zstd",
  pack: bytes => OWN(compress(bytes, LEVEL)),
  unpack(packed, size) {
    if (size > LARGEST_CHUNK || frameContentSize(packed) !== size) return null;
    let bytes: Uint8Array;
    // The library has one way to say that bytes are damaged.
    try {
      bytes = decompress(packed);
    } catch {
      return null;
    }
    return bytes.length === size ? OWN(bytes) : null;
  },
};

let loading: Promise<Packing> | null = null;
/** Zstandard as WebAssembly, in Node and in browsers; loaded once. */
export function zstd(): Promise<Packing> {
  return (loading ??= init().then(() => packing));
}
