import { Opcode } from "@mcap/core";
import { LARGEST_CHUNK } from "./packing.ts";

/** Opcode, then the length of what follows. */
export const RECORD_HEAD = 1 + 8;
/** Start, end, size, checksum, length of the name of the packing, length of what is packed. */
const CHUNK_HEAD = 8 + 8 + 8 + 4 + 4 + 8;
/** What must be at hand to tell a chunk from something else: with the longest name. */
export const CHUNK_LOOK = RECORD_HEAD + CHUNK_HEAD + 4;

/** Where the parts of a chunk are, counted from the first byte of its record. */
export interface ChunkShape {
  /** The whole record. */
  readonly length: number;
  /** "" when its messages stand as they are. */
  readonly packing: "" | "lz4" | "zstd";
  readonly recordsAt: number;
  readonly recordsLength: number;
  /** Bytes of the messages, unpacked. */
  readonly size: number;
  readonly checksum: number;
  readonly start_ns: bigint;
  readonly end_ns: bigint;
}

/** The chunk whose record begins there, if its lengths agree with each other, whatever its opcode says; else null. */
export function chunkShape(view: DataView, at: number): ChunkShape | null {
  const body = at + RECORD_HEAD;
  if (at < 0 || body + CHUNK_HEAD > view.byteLength || view.getUint32(at + 5, true) !== 0) return null;
  const name = view.getUint32(body + 28, true);
  if (name !== 0 && name !== 3 && name !== 4) return null;
  if (
    body + CHUNK_HEAD + name > view.byteLength ||
    view.getUint32(body + 20, true) !== 0 ||
    view.getUint32(body + 36 + name, true) !== 0
  )
    return null;
  let packing = "";
  for (let i = 0; i < name; i++) packing += String.fromCharCode(view.getUint8(body + 32 + i));
  if (packing !== "" && packing !== "lz4" && packing !== "zstd") return null;
  const inside = view.getUint32(at + 1, true);
  const recordsLength = view.getUint32(body + 32 + name, true);
  const size = view.getUint32(body + 16, true);
  if (
    inside !== CHUNK_HEAD + name + recordsLength ||
    size > LARGEST_CHUNK ||
    (packing === "" && size !== recordsLength)
  )
    return null;
  return {
    length: RECORD_HEAD + inside,
    packing,
    recordsAt: RECORD_HEAD + CHUNK_HEAD + name,
    recordsLength,
    size,
    checksum: view.getUint32(body + 24, true),
    start_ns: view.getBigUint64(body, true),
    end_ns: view.getBigUint64(body + 8, true),
  };
}

/**
 * Start of the next record from there that looks like a chunk lying whole before `until`; `until` when there is none.
 */
export function nextChunk(bytes: Uint8Array, view: DataView, from: number, until: number): number {
  for (let at = bytes.indexOf(Opcode.CHUNK, from); at >= 0 && at < until; at = bytes.indexOf(Opcode.CHUNK, at + 1)) {
    const shape = chunkShape(view, at);
    if (shape && at + shape.length <= bytes.length) return at;
  }
  return until;
}
