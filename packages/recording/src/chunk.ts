import { crc32 } from "@foxglove/crc";
import { Opcode, McapRecordBuilder, type ChunkIndex } from "@mcap/core";
import type { Packing } from "./packing.ts";

const TWO_32 = 2 ** 32;
/** Opcode, length, channel, sequence, log time, publish time. */
const MESSAGE_HEAD = 1 + 8 + 2 + 4 + 8 + 8;

/** Opcode, length, channel, length of the list. */
const INDEX_HEAD = 1 + 8 + 2 + 4;

/** The message index of one channel as the file wants it: a head, then pairs of time and offset, sixteen bytes each. */
interface ChannelIndex {
  bytes: Uint8Array<ArrayBuffer>;
  view: DataView;
  count: number;
}

/**
 * The open chunk. Message records are written straight into one reused buffer: McapWriter's way through bigints, arrays
 * and promises costs more than the rest of the recorder together. Everything that is not per message is left to it.
 */
export class OpenChunk {
  bytes: Uint8Array<ArrayBuffer>;
  view: DataView;
  length = 0;
  /** Nanoseconds after the start of the recording. */
  first_ns = 0;
  last_ns = 0;
  messages = 0;
  readonly #indexes: ChannelIndex[];
  readonly #startedAt_ns: bigint;
  readonly #startHigh: number;
  readonly #startLow: number;

  /** @param channels  channel ids are 0 … channels − 1. */
  constructor(capacity: number, channels: number, startedAt_ns: bigint) {
    this.bytes = new Uint8Array(capacity);
    this.view = new DataView(this.bytes.buffer);
    this.#indexes = Array.from({ length: channels }, () => {
      const bytes = new Uint8Array(16 * 1024);
      return { bytes, view: new DataView(bytes.buffer), count: 0 };
    });
    this.#startedAt_ns = startedAt_ns;
    this.#startHigh = Number(startedAt_ns >> 32n);
    this.#startLow = Number(startedAt_ns & 0xffffffffn);
  }

  /** Bytes that are no message: schemas and channels. */
  raw(record: Uint8Array): void {
    this.#reserve(record.length);
    this.bytes.set(record, this.length);
    this.length += record.length;
  }

  /** Writes the head of a message of that many bytes. @returns where its data must now be written. */
  message(channel: number, sequence: number, at_ns: number, size: number): number {
    this.#reserve(MESSAGE_HEAD + size);
    const { view } = this;
    const at = this.length;
    view.setUint8(at, Opcode.MESSAGE);
    view.setUint32(at + 1, MESSAGE_HEAD - 9 + size, true);
    view.setUint32(at + 5, 0, true);
    view.setUint16(at + 9, channel, true);
    view.setUint32(at + 11, sequence, true);
    this.#time(view, at + 15, at_ns);
    this.#time(view, at + 23, at_ns);
    this.#index(this.#indexes[channel]!, at, at_ns);
    if (this.messages++ === 0) this.first_ns = at_ns;
    this.last_ns = at_ns;
    this.length = at + MESSAGE_HEAD + size;
    return at + MESSAGE_HEAD;
  }

  /**
   * Ends the chunk; it is empty afterwards.
   *
   * @param position  where in the file the pieces will stand, one after the other.
   * @param packing   packs the messages; left out, they stand as they are.
   */
  close(position: number, packing?: Packing): { readonly pieces: readonly Uint8Array[]; readonly index: ChunkIndex } {
    const records = this.bytes.subarray(0, this.length);
    const size = BigInt(this.length);
    const times = {
      messageStartTime: this.#startedAt_ns + BigInt(this.first_ns),
      messageEndTime: this.#startedAt_ns + BigInt(this.last_ns),
    };
    const builder = new McapRecordBuilder();
    const stored = packing ? packing.pack(records) : records;
    const compression = packing?.name ?? "";
    const chunkLength = builder.writeChunk({
      ...times,
      uncompressedSize: size,
      uncompressedCrc: crc32(records),
      compression,
      records: stored,
    });
    const pieces: Uint8Array[] = [builder.buffer];
    const messageIndexOffsets = new Map<number, bigint>();
    const indexStart = position + builder.length;
    let indexLength = 0;
    this.#indexes.forEach((index, channel) => {
      if (index.count === 0) return;
      messageIndexOffsets.set(channel, BigInt(indexStart + indexLength));
      const piece = index.bytes.slice(0, INDEX_HEAD + 16 * index.count);
      const view = new DataView(piece.buffer);
      view.setUint8(0, Opcode.MESSAGE_INDEX);
      view.setBigUint64(1, BigInt(piece.length - 9), true);
      view.setUint16(9, channel, true);
      view.setUint32(11, 16 * index.count, true);
      pieces.push(piece);
      indexLength += piece.length;
      index.count = 0;
    });
    this.length = 0;
    this.messages = 0;
    return {
      pieces,
      index: {
        ...times,
        chunkStartOffset: BigInt(position),
        chunkLength,
        messageIndexOffsets,
        messageIndexLength: BigInt(indexLength),
        compression,
        compressedSize: BigInt(stored.length),
        uncompressedSize: size,
      },
    };
  }

  /** startedAt + at, as 64 bits, without a bigint. */
  #time(view: DataView, at: number, at_ns: number): void {
    const low = this.#startLow + (at_ns % TWO_32);
    const carry = low >= TWO_32 ? 1 : 0;
    view.setUint32(at, low - carry * TWO_32, true);
    view.setUint32(at + 4, this.#startHigh + Math.floor(at_ns / TWO_32) + carry, true);
  }

  #index(index: ChannelIndex, offset: number, at_ns: number): void {
    const at = INDEX_HEAD + 16 * index.count++;
    if (at + 16 > index.bytes.length) {
      const larger = new Uint8Array(2 * index.bytes.length);
      larger.set(index.bytes);
      index.bytes = larger;
      index.view = new DataView(larger.buffer);
    }
    this.#time(index.view, at, at_ns);
    index.view.setUint32(at + 8, offset, true);
    index.view.setUint32(at + 12, 0, true);
  }

  #reserve(size: number): void {
    if (this.length + size <= this.bytes.length) return;
    const larger = new Uint8Array(Math.max(2 * this.bytes.length, this.length + size));
    larger.set(this.bytes.subarray(0, this.length));
    this.bytes = larger;
    this.view = new DataView(larger.buffer);
  }
}
