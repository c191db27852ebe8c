import { crc32 } from "@foxglove/crc";
import { hasMcapPrefix, MCAP_MAGIC, McapStreamReader, Opcode } from "@mcap/core";
import { createDecoder, factsFrom, json, type RunFacts } from "../decode.ts";
import { createDigester, digestFrom, type Digest } from "../digest.ts";
import { RECORD_HEAD, type ChunkShape } from "../layout.ts";
import type { Packing } from "../packing.ts";
import { NO_RUN, NO_SAMPLE, NOT_MCAP, packedWith, walk } from "../read.ts";
import { utf8Bytes } from "../text.ts";
import { DIGEST_METADATA, RUN_METADATA } from "../topics.ts";
import type { FilePort, StoredFile } from "./port.ts";

export interface ChunkPlace {
  readonly at: number;
  readonly length: number;
  readonly from_s: number;
  readonly to_s: number;
}
/** A file of the history, opened by its index; one without is gone through once. */
export interface CatalogueFile {
  readonly name: string;
  readonly bytes: number;
  readonly facts: RunFacts;
  /** Where its chunks are, by time since the start of this file. */
  readonly chunks: readonly ChunkPlace[];
  readonly digest: Digest;
  readonly complete: boolean;
  readonly damaged: number;
}
export type Catalogued =
  | { readonly kind: "file"; readonly file: CatalogueFile }
  | { readonly kind: "not-a-recording"; readonly sentence: string };

/** A file without its index is read whole; one above this is not. */
const LARGEST_UNFINISHED = 1_000_000_000;
const MAGIC = MCAP_MAGIC.length;
const FOOTER = RECORD_HEAD + 8 + 8 + 4;

export async function catalogue(
  port: FilePort,
  { name, bytes }: StoredFile,
  packing: Packing | undefined,
): Promise<Catalogued> {
  const head = await port.read(name, 0, MAGIC);
  if (head.length === 0) return { kind: "not-a-recording", sentence: "The file is empty." };
  if (!hasMcapPrefix(viewOf(head))) return { kind: "not-a-recording", sentence: NOT_MCAP };
  const indexed = await byIndex(port, name, bytes, packing);
  if (indexed) return indexed;
  if (bytes > LARGEST_UNFINISHED)
    return {
      kind: "not-a-recording",
      sentence: `The file has no index and is larger than ${LARGEST_UNFINISHED / 1e6} MB.`,
    };
  return byWalking(name, await port.read(name, 0, bytes), packing);
}

const viewOf = (bytes: Uint8Array): DataView => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

/** By the index behind the data; null when it is not there, not whole, or does not say all. */
async function byIndex(
  port: FilePort,
  name: string,
  size: number,
  packing: Packing | undefined,
): Promise<Catalogued | null> {
  if (size < MAGIC + FOOTER + MAGIC) return null;
  const tail = await port.read(name, size - FOOTER - MAGIC, FOOTER + MAGIC);
  const footer = viewOf(tail);
  if (tail.length < FOOTER + MAGIC || tail[0] !== Opcode.FOOTER || !hasMcapPrefix(viewOf(tail.subarray(FOOTER))))
    return null;
  const from = Number(footer.getBigUint64(RECORD_HEAD, true));
  const checksum = footer.getUint32(RECORD_HEAD + 16, true);
  if (!(from > 0 && from < size - FOOTER - MAGIC)) return null;
  const summary = await port.read(name, from, size - FOOTER - MAGIC - from);
  const covered = new Uint8Array(summary.length + FOOTER - 4);
  covered.set(summary);
  covered.set(tail.subarray(0, FOOTER - 4), summary.length);
  if (checksum === 0 || crc32(covered) !== checksum) return null;

  const places: ChunkPlace[] = [];
  const metadata = new Map<string, { at: number; length: number }>();
  const view = viewOf(summary);
  const times: [bigint, bigint][] = [];
  for (let at = 0; at + RECORD_HEAD <= summary.length; ) {
    const length = Number(view.getBigUint64(at + 1, true));
    const body = at + RECORD_HEAD;
    if (body + length > summary.length) return null;
    if (summary[at] === Opcode.CHUNK_INDEX && length >= 32) {
      times.push([view.getBigUint64(body, true), view.getBigUint64(body + 8, true)]);
      places.push({
        at: Number(view.getBigUint64(body + 16, true)),
        length: Number(view.getBigUint64(body + 24, true)),
        from_s: 0,
        to_s: 0,
      });
      const packed = packingOf(view, body);
      if (packed !== "" && packed !== packing?.name) return { kind: "not-a-recording", sentence: packedWith(packed) };
    } else if (summary[at] === Opcode.METADATA_INDEX) {
      const read = record(summary.subarray(at, body + length));
      if (read?.type === "MetadataIndex")
        metadata.set(read.name, { at: Number(read.offset), length: Number(read.length) });
    }
    at = body + length;
  }
  const said = async (key: string): Promise<ReadonlyMap<string, string> | null> => {
    const place = metadata.get(key);
    const read = place && record(await port.read(name, place.at, place.length));
    return read?.type === "Metadata" ? read.metadata : null;
  };
  const run = await said(RUN_METADATA);
  if (!run) return { kind: "not-a-recording", sentence: NO_RUN };
  const facts = factsFrom(run);
  const summedUp = await said(DIGEST_METADATA);
  const digest = summedUp && digestFrom(json(utf8Bytes(summedUp.get("json") ?? "")));
  if (!facts || !digest) return null;
  if (places.length === 0) return { kind: "not-a-recording", sentence: NO_SAMPLE };
  const since_s = (at_ns: bigint): number => Number(at_ns - facts.startedAt_ns) / 1e9;
  return {
    kind: "file",
    file: {
      name,
      bytes: size,
      facts,
      chunks: places.map((place, i) => ({ ...place, from_s: since_s(times[i]![0]), to_s: since_s(times[i]![1]) })),
      digest,
      complete: true,
      damaged: 0,
    },
  };
}

/** Of a chunk index: behind times, place, length, the map of message indexes and their length. */
function packingOf(view: DataView, body: number): string {
  const at = body + 32 + 4 + view.getUint32(body + 32, true) + 8;
  const length = view.getUint32(at, true);
  let name = "";
  for (let i = 0; i < Math.min(length, 8); i++) name += String.fromCharCode(view.getUint8(at + 4 + i));
  return name;
}
function record(bytes: Uint8Array) {
  const reader = new McapStreamReader({ noMagicPrefix: true });
  reader.append(bytes);
  // A record that is damaged inside says nothing; the library has one way to say so.
  try {
    return reader.nextRecord();
  } catch {
    return undefined;
  }
}

/** By going through it: what is whole counts, and is summed up again. */
function byWalking(name: string, bytes: Uint8Array, packing: Packing | undefined): Catalogued {
  const view = viewOf(bytes);
  const places: { at: number; shape: ChunkShape }[] = [];
  const finder = createDecoder(packing);
  let packed = "";
  const { complete, damaged } = walk(bytes, {
    metadata: ({ name: key, metadata }) => {
      if (key === RUN_METADATA) finder.run(metadata);
    },
    chunk(at, shape) {
      const taken = createDecoder(packing, finder.facts, 256).chunk(bytes, view, at, shape);
      if (taken === "unreadable") packed = shape.packing;
      if (taken === "no-run-yet") finder.chunk(bytes, view, at, shape);
      if (taken !== "damaged") places.push({ at, shape });
      return taken !== "damaged";
    },
  });
  const { facts } = finder;
  if (packed !== "") return { kind: "not-a-recording", sentence: packedWith(packed) };
  if (!facts) return { kind: "not-a-recording", sentence: NO_RUN };
  const digester = createDigester(facts.joints, facts.cycle);
  const chunks: ChunkPlace[] = [];
  for (const { at, shape } of places) {
    const decoder = createDecoder(packing, facts, 256);
    if (decoder.chunk(bytes, view, at, shape) !== "taken") continue;
    const { times_s, q_rad, stateOf, states, events, notes } = decoder.samples();
    const since_s = (at_ns: bigint): number => Number(at_ns - facts.startedAt_ns) / 1e9;
    chunks.push({ at, length: shape.length, from_s: since_s(shape.start_ns), to_s: since_s(shape.end_ns) });
    for (const event of events) digester.event(event.at_s, event.kind, event.level, event.sentence);
    for (const note of notes) digester.note(note);
    times_s.forEach((at_s, i) => {
      digester.sample(at_s, q_rad.subarray(i * facts.joints, (i + 1) * facts.joints), states[stateOf[i]!]!);
    });
  }
  if (chunks.length === 0) return { kind: "not-a-recording", sentence: NO_SAMPLE };
  return {
    kind: "file",
    file: { name, bytes: bytes.length, facts, chunks, digest: digester.result(), complete, damaged },
  };
}
