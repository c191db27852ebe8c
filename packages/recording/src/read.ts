import { hasMcapPrefix, McapStreamReader, Opcode } from "@mcap/core";
import { createDecoder, type RunFacts, type Samples } from "./decode.ts";
import { chunkShape, nextChunk, RECORD_HEAD, type ChunkShape } from "./layout.ts";
import type { Packing } from "./packing.ts";
import { DIGEST_METADATA, RUN_METADATA, TOPICS } from "./topics.ts";

/** A recording read whole. Times count from its first sample. */
export interface RecordingData extends RunFacts, Samples {
  /** False when the file ends before its index: the run was cut off. */
  readonly complete: boolean;
  /** Places where bytes were damaged and a chunk was left out. */
  readonly damaged: number;
}
export type Read =
  | { readonly kind: "read"; readonly data: RecordingData }
  | { readonly kind: "not-a-recording"; readonly sentence: string };

export const NOT_MCAP = "The file does not begin like an MCAP file.";
export const NO_RUN = `The file is MCAP but holds no joint angles of a run (no ${TOPICS[0]!.topic} with ${RUN_METADATA}).`;
export const NO_SAMPLE = "The recording ends before its first sample.";
export const packedWith = (packing: string): string =>
  `The file's chunks are packed with ${packing}, which is not read here.`;

/**
 * Reads a recording, whole, cut off anywhere or damaged: what is lost is the chunk that is not whole, and no more.
 *
 * @param packing  unpacks the chunks of a compact recording; without it such a file is said to be packed.
 */
export function readRecording(bytes: Uint8Array, packing?: Packing): Read {
  if (!hasMcapPrefix(new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength))) {
    return { kind: "not-a-recording", sentence: bytes.length === 0 ? "The file is empty." : NOT_MCAP };
  }
  const decoder = createDecoder(packing);
  const early: { at: number; shape: ChunkShape }[] = [];
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let packed = "";
  const { complete, damaged } = walk(bytes, {
    metadata: record => {
      if (record.name === RUN_METADATA) decoder.run(record.metadata);
    },
    chunk(at, shape) {
      const taken = decoder.chunk(bytes, view, at, shape);
      if (taken === "unreadable") packed = shape.packing;
      if (taken === "no-run-yet") early.push({ at, shape });
      return taken !== "damaged";
    },
  });
  if (packed !== "") return { kind: "not-a-recording", sentence: packedWith(packed) };
  if (!decoder.facts) return { kind: "not-a-recording", sentence: NO_RUN };
  // The head was damaged: what came before the first chunk that says which run it is.
  let all = decoder;
  if (early.length > 0) {
    all = createDecoder(packing, decoder.facts);
    walk(bytes, { metadata: () => undefined, chunk: (at, shape) => all.chunk(bytes, view, at, shape) !== "damaged" });
  }
  const samples = all.samples();
  if (samples.times_s.length === 0) return { kind: "not-a-recording", sentence: NO_SAMPLE };
  return { kind: "read", data: { ...decoder.facts, ...samples, complete, damaged } };
}

export interface Walker {
  /** False: it is damaged, and what follows is searched from its second byte. */
  chunk(at: number, shape: ChunkShape): boolean;
  metadata(record: { readonly name: string; readonly metadata: ReadonlyMap<string, string> }): void;
}

/** Goes through the records of a file; where one is damaged, on to the next chunk that is whole. */
export function walk(bytes: Uint8Array, to: Walker): { readonly complete: boolean; readonly damaged: number } {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 8;
  let damaged = 0;
  let complete = false;
  while (!complete && at + RECORD_HEAD <= bytes.length) {
    const opcode = view.getUint8(at);
    const end = at + RECORD_HEAD + Number(view.getBigUint64(at + 1, true));
    const shape = chunkShape(view, at);
    let sound = opcode >= 1 && opcode <= Opcode.MAX && end <= bytes.length;
    if (sound && opcode === Opcode.CHUNK) {
      // A chunk whose lengths do not agree is damaged, even if its checksum holds: it would swallow what follows.
      sound = shape !== null && to.chunk(at, shape);
    } else if (sound) {
      // A record that is, or holds, something shaped like a chunk has a wrong opcode or a wrong length.
      sound = shape === null && nextChunk(bytes, view, at + 1, end) === end;
      if (sound && opcode === Opcode.METADATA) metadata(bytes.subarray(at, end), to);
      complete =
        sound &&
        opcode === Opcode.FOOTER &&
        hasMcapPrefix(new DataView(bytes.buffer, bytes.byteOffset + end, bytes.length - end));
    }
    if (sound) {
      at = end;
      continue;
    }
    const next = nextChunk(bytes, view, at + 1, bytes.length);
    // What is cut off at the end is an unfinished chunk, not a damaged one.
    if (next < bytes.length || opcode < 1 || opcode > Opcode.MAX || end <= bytes.length) damaged++;
    at = next;
  }
  return { complete, damaged };
}

export function metadata(record: Uint8Array, to: Pick<Walker, "metadata">): void {
  const reader = new McapStreamReader({ noMagicPrefix: true });
  reader.append(record);
  let read: ReturnType<McapStreamReader["nextRecord"]>;
  // A record that is damaged inside says nothing; the library has one way to say so.
  try {
    read = reader.nextRecord();
  } catch {
    return;
  }
  if (read?.type === "Metadata" && (read.name === RUN_METADATA || read.name === DIGEST_METADATA)) to.metadata(read);
}
