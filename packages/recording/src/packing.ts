/** Packs the chunks of a recording. Node and the page bring the same one (`@twincell/recording/zstd`). */
export interface Packing {
  /** As MCAP calls it. */
  readonly name: "zstd";
  /** Returns fresh bytes. */
  pack(bytes: Uint8Array): Uint8Array<ArrayBuffer>;
  /** The bytes that were packed, or null when these are not `size` bytes packed like that. */
  unpack(packed: Uint8Array, size: number): Uint8Array<ArrayBuffer> | null;
}

/** No chunk of ours comes near it; a length above it is damage, not data. */
export const LARGEST_CHUNK = 64 * 1024 * 1024;

const MAGIC = 0xfd2fb528;
/** Bytes of the dictionary id and of the content size by their flags (RFC 8878, 3.1.1.1). */
const DICTIONARY_BYTES = [0, 1, 2, 4] as const;
const SIZE_BYTES = [0, 2, 4, 8] as const;

/**
 * How many bytes a zstd frame says it holds: asked before room is made for them, since a damaged frame may say
 * anything.
 *
 * @returns -1 when it does not say, or is no zstd frame.
 */
export function frameContentSize(packed: Uint8Array): number {
  if (packed.length < 6) return -1;
  const view = new DataView(packed.buffer, packed.byteOffset, packed.byteLength);
  if (view.getUint32(0, true) !== MAGIC) return -1;
  const flags = packed[4]!;
  const single = (flags & 0x20) !== 0;
  const bytes = flags >> 6 === 0 ? (single ? 1 : 0) : SIZE_BYTES[flags >> 6]!;
  const at = 5 + (single ? 0 : 1) + DICTIONARY_BYTES[flags & 3]!;
  if (bytes === 0 || at + bytes > packed.length) return -1;
  switch (bytes) {
    case 1:
      return packed[at]!;
    case 2:
      return view.getUint16(at, true) + 256;
    case 4:
      return view.getUint32(at, true);
    default:
      return Number(view.getBigUint64(at, true));
  }
}
